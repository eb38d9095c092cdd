//! What is written down about certificates, sweeps, searches and audits: pages, pictures, text and
//! JSON.

pub mod audit;
mod caption;
pub mod explanation;
pub mod junit;
mod labels;
mod number;
pub mod page;
pub mod picture;
pub mod prices;
mod svg;
pub mod tuning;
mod view;
