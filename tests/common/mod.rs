//! What the integration tests share: the independent oracle, its cases and their conditioning.
#![allow(dead_code, reason = "every test binary compiles this module and uses its own part of it")]

pub mod cases;
pub mod conditioning;
pub mod oracle;
