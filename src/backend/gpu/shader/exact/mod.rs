//! Arithmetic that no driver changes: a pass over a kernel after which every sum, difference, product, quotient and square root
//! is rounded as IEEE 754 asks, in the order of the source.
//!
//! WGSL lets a driver contract a product and a sum, reorder what it takes for equal, and divide to within 2.5 units in the
//! last place. Here the result of every operation is read as bits, combined with a zero that only the running kernel knows,
//! and read as a number again: what lies on the two sides cannot be merged. Quotients and square roots become calls of
//! functions that correct what the driver gives (`shaders/shared/exact.wgsl`).

mod arithmetic;
mod body;
mod pass;
mod place;
mod refused;
#[cfg(test)]
mod tests;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Function, GlobalVariable, Handle, Module, TypeInner};

pub use arithmetic::Arithmetic;
use pass::{Calls, Pass};
use refused::Refused;

/// What quotients and square roots become calls of; they are left alone themselves.
const DIVIDE: &str = "exact_quotient";
const ROOT: &str = "exact_root";

/// The parameters of a dispatch, and their member of type u32 that is 0 or 1, from which the zero is made.
const DISPATCH: (&str, &str) = ("dispatch", "begin");

/// Makes the arithmetic of a kernel exact.
///
/// # Errors
/// What the source has that the pass does not know.
pub fn exact(source: &str) -> Result<Module, Refused> {
    let mut module = naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|error| error.emit_to_string(source))?;
    let named = |name: &str| {
        let mut functions = module.functions.iter();
        let found = functions.find(|(_, function)| function.name.as_deref() == Some(name));
        found.map(|(handle, _)| handle).ok_or_else(|| format!("the shader has no function {name}"))
    };
    let calls = Calls { divide: named(DIVIDE)?, root: named(ROOT)? };
    let zero = zero(&module)?;
    let functions: Vec<Handle<Function>> = module.functions.iter().map(|(handle, _)| handle).collect();
    for handle in functions {
        let function = std::mem::take(module.functions.get_mut(handle));
        let calls = (![calls.divide, calls.root].contains(&handle)).then_some(calls);
        *module.functions.get_mut(handle) =
            Pass { info: &info[handle], types: &module.types, zero, calls }.function(function)?;
    }
    for index in 0..module.entry_points.len() {
        let function = std::mem::take(&mut module.entry_points[index].function);
        let info = info.get_entry_point(index);
        module.entry_points[index].function =
            Pass { info, types: &module.types, zero, calls: Some(calls) }.function(function)?;
    }
    Ok(module)
}

/// Where the zero comes from.
fn zero(module: &Module) -> Result<(Handle<GlobalVariable>, u32), Refused> {
    let (name, member) = DISPATCH;
    let (handle, variable) = module
        .global_variables
        .iter()
        .find(|(_, variable)| variable.name.as_deref() == Some(name))
        .ok_or_else(|| format!("the shader has no variable {name}"))?;
    let TypeInner::Struct { members, .. } = &module.types[variable.ty].inner else {
        return Err(format!("{name} is no struct"));
    };
    let index = members.iter().position(|found| found.name.as_deref() == Some(member));
    index.map(|index| (handle, index as u32)).ok_or_else(|| format!("{name} has no member {member}"))
}
