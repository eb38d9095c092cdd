//! A sheet of cloth, rolled up, that falls and trembles.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tunnelproof::Mesh;

/// A position in metres.
pub(crate) type Position = [f64; 3];

/// A square sheet of so many vertices on each side, rolled up in turns 7.5 cm apart.
pub(crate) fn rolled_sheet(side: u32) -> (Mesh, Vec<Position>, Vec<Position>) {
    let rng = &mut ChaCha8Rng::seed_from_u64(1);
    let spacing = 1.0 / f64::from(side);
    let mut noise = |size: f64| [(); 3].map(|()| rng.random_range(-0.5..0.5) * size * spacing);
    let (mut start, mut end) = (Vec::new(), Vec::new());
    for i in 0..side {
        for j in 0..side {
            let [x, y] = [i, j].map(|k| f64::from(k) * spacing);
            let angle = 12.0 * x;
            let radius = 0.2 + 0.012 * angle;
            let tremble = noise(0.1);
            let at = [radius * angle.cos(), radius * angle.sin(), y];
            let at = [0, 1, 2].map(|k| at[k] + tremble[k]);
            let tremble = noise(0.3);
            start.push(at);
            end.push([
                0.98 * at[0] + tremble[0],
                at[1] + 0.01 + tremble[1],
                at[2] - 0.5 * spacing + tremble[2],
            ]);
        }
    }
    let mut faces = Vec::new();
    for i in 0..side - 1 {
        for j in 0..side - 1 {
            let [a, b] = [i * side + j, (i + 1) * side + j];
            faces.extend([[a, a + 1, b], [a + 1, b + 1, b]]);
        }
    }
    let mesh = Mesh::new(start.len(), &[], &faces).expect("indices are those of vertices");
    (mesh, start, end)
}
