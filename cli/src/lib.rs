//! What the command `tunnelproof` is made of: sweeps and searches over the thesis' thresholds,
//! scenes and their audit, meshes from files, pages, test vectors and fuzz targets.

pub mod audit;
pub mod fuzz;
pub mod meshes;
pub mod perturb;
pub mod replay;
pub mod report;
pub mod rows;
pub mod scenes;
pub mod simulate;
pub mod sweep;
pub mod tables;
pub mod tune;
pub mod vectors;
pub mod vtk;

/// The examples of the pages in `docs/`, as tests.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../../docs/broad.md")]
    struct Broad;
    #[doc = include_str!("../../docs/cloth-and-hair.md")]
    struct ClothAndHair;
    #[doc = include_str!("../../docs/engines.md")]
    struct Engines;
    #[doc = include_str!("../../docs/meshes.md")]
    struct Meshes;
    #[doc = include_str!("../../docs/wires.md")]
    struct Wires;
}
