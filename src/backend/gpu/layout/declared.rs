//! Structs in the GPU's buffers, declared once: the text of the shaders is written from the Rust struct.

/// Declares a struct on both sides. Its members are of 32 bits, or arrays or structs of such: either side lays them out one
/// after the other, without padding.
macro_rules! shared_struct {
    ($(#[$about:meta])* pub struct $name:ident { $($(#[$note:meta])* pub $member:ident: $kind:tt,)+ }) => {
        $(#[$about])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
        pub struct $name {
            $($(#[$note])* pub $member: $kind,)+
        }

        impl $name {
            /// Its declaration in WGSL.
            pub const WGSL: &str = concat!(
                "struct ", stringify!($name), " {\n",
                $("    ", stringify!($member), ": ", wgsl_type!($kind), ",\n",)+
                "}\n",
            );
        }
    };
}

/// A type of Rust in WGSL; the length of an array is a constant that both have.
macro_rules! wgsl_type {
    ([$of:tt; $length:tt]) => {
        concat!("array<", stringify!($of), ", ", stringify!($length), ">")
    };
    ($name:tt) => {
        stringify!($name)
    };
}
