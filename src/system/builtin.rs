//! The families that come with the program.

/// A family that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Builtin {
    /// The name to ask for it by.
    pub name: &'static str,
    /// Its file.
    pub text: &'static str,
}

macro_rules! builtin {
    ($name:literal) => {
        Builtin { name: $name, text: include_str!(concat!("families/", $name, ".toml")) }
    };
}

/// Every family that comes with the program.
pub const BUILTIN: [Builtin; 8] = [
    builtin!("luo-ma-lv"),
    builtin!("shaw-holmes"),
    builtin!("bouncing-ball"),
    builtin!("impact-pair"),
    builtin!("two-sided"),
    builtin!("three-mass-chain"),
    builtin!("colliding-pair"),
    builtin!("impact-damper"),
];

/// The file of the family of a name, if one comes with the program.
pub fn builtin(name: &str) -> Option<&'static str> {
    BUILTIN.iter().find(|family| family.name == name).map(|family| family.text)
}
