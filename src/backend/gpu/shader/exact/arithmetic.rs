//! How a kernel computes.

/// How a kernel computes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Arithmetic {
    /// As the driver likes, within what WGSL allows.
    #[default]
    Native,
    /// Every operation rounded correctly, in the order of the source: the bits of the processor's f32.
    Exact,
}

impl Arithmetic {
    /// Functions that kernels of this arithmetic have.
    pub fn source(self) -> &'static str {
        match self {
            Arithmetic::Native => "",
            Arithmetic::Exact => include_str!("../../../../../shaders/shared/exact.wgsl"),
        }
    }
}
