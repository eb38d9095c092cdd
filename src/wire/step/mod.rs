//! One step: SPOOK with contacts.

mod active_set;
pub(super) mod advance;
mod anderson;
mod augmented;
mod budget;
pub(super) mod callbacks;
mod capstan;
mod carrier;
mod constitutive;
mod contact_blocks;
pub(super) mod contact_nodes;
mod coulomb;
mod delassus;
mod friction;
mod friction_bounds;
mod gmres;
mod implicit;
pub(super) mod motion;
mod multipliers;
mod order;
mod rows;
mod softness;
mod solve_step;
mod spin;
mod start;
mod system;
pub(super) mod transverse;
