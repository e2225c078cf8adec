//! Impact Atlas: parameter planes of vibro-impact systems, explored on the GPU.

pub mod analysis;
pub mod backend;
pub mod dynamics;
pub mod model;
pub mod plane;
pub mod render;
pub mod store;
pub mod sweep;
pub mod validate;
