//! What the integration tests share: the independent oracle, its cases and their conditioning.
#![allow(
    dead_code,
    unused_imports,
    reason = "every test binary compiles this module and uses its own part of it"
)]

pub mod adapter;
pub mod cases;
pub mod comparison;
pub mod conditioning;
pub mod oracle;
pub mod settled;
