//! One step: SPOOK with contacts.

pub(super) mod advance;
mod anderson;
mod augmented;
mod capstan;
mod carrier;
pub(super) mod contact;
mod coulomb;
mod delassus;
mod error;
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
pub(super) mod system;
mod touching;
pub(super) mod watch;

pub use capstan::Slide;
pub use contact::{Contact, Place};
pub use error::{Reason, StepError};
