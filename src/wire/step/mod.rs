//! One step: SPOOK with contacts.

pub(super) mod advance;
mod anderson;
mod augmented;
mod capstan;
mod carrier;
mod coulomb;
mod delassus;
mod friction;
mod implicit;
mod law;
pub(super) mod motion;
mod order;
pub(super) mod ride;
mod rows;
mod settle;
mod slack;
mod spin;
mod system;
mod touching;
pub(super) mod watch;
