//! What the playground's page asks of the judge and the methods, as JSON in and JSON out: the same
//! functions natively and in WebAssembly, where [`abi`] exports them.

pub mod abi;
mod ask;
mod search;

pub use ask::{AskError, answer};
