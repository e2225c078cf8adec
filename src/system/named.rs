//! Enums whose cases have names.

/// An enum whose cases each have one name: the one that files, the command line and people read.
macro_rules! named {
    ($(#[$about:meta])* $vis:vis enum $name:ident { $($(#[$what:meta])* $case:ident = $text:literal,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, strum::EnumString, strum::IntoStaticStr)]
        $vis enum $name {
            $($(#[$what])* #[serde(rename = $text)] #[strum(serialize = $text)] $case,)+
        }

        impl $name {
            /// The name of the case.
            $vis fn name(self) -> &'static str {
                self.into()
            }
        }
    };
}
pub(crate) use named;
