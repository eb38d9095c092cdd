//! What is written down about certificates, sweeps, searches, audits and steps: pages, pictures,
//! text and JSON.

pub mod audit;
pub mod badge;
mod caption;
pub mod cast;
pub mod junit;
mod labels;
pub mod mesh;
pub mod page;
pub mod picture;
pub mod prices;
pub mod step;
mod svg;
pub mod tuning;
pub mod turning;
mod view;
