//! What the integration tests share: the independent oracle, its cases and their conditioning.

pub mod adapter;
pub mod cases;
pub mod comparison;
pub mod conditioning;
pub mod drawn;
pub mod general;
pub mod oracle;
pub mod scaled;
pub mod settled;
