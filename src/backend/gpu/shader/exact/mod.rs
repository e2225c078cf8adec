//! Arithmetic that no driver changes: a pass over a kernel after which every sum, difference, product, quotient and square root
//! is rounded as IEEE 754 asks, in the order of the source.
//!
//! WGSL lets a driver contract a product and a sum, reorder what it takes for equal, and divide to within 2.5 units in the
//! last place. Here the result of every operation is read as bits, combined with a zero that only the running kernel knows,
//! and read as a number again: what lies on the two sides cannot be merged. Quotients and square roots become calls of
//! functions that correct what the driver gives (`shaders/shared/exact.wgsl`).

mod body;
mod moved;
mod place;

use naga::valid::{Capabilities, FunctionInfo, ValidationFlags, Validator};
use naga::{
    Arena, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, Literal, MathFunction,
    Module, Range, ScalarKind, Span, Statement, Type, TypeInner, UniqueArena, VectorSize,
};

use body::Body;
use moved::moved;
use place::{Call, Place, called};

pub use place::Refused;

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

/// What quotients and square roots become calls of; they are left alone themselves.
const DIVIDE: &str = "exact_quotient";
const ROOT: &str = "exact_root";

/// The uniform, and its member of type u32 that is 0 or 1, from which the zero is made.
const UNIFORM: (&str, &str) = ("dispatch", "begin");

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
    let (name, member) = UNIFORM;
    let (handle, variable) = module
        .global_variables
        .iter()
        .find(|(_, variable)| variable.name.as_deref() == Some(name))
        .ok_or_else(|| format!("the shader has no uniform {name}"))?;
    let TypeInner::Struct { members, .. } = &module.types[variable.ty].inner else {
        return Err(format!("{name} is no struct"));
    };
    let index = members.iter().position(|found| found.name.as_deref() == Some(member));
    index.map(|index| (handle, index as u32)).ok_or_else(|| format!("{name} has no member {member}"))
}

/// The functions that are called for quotients and square roots.
#[derive(Clone, Copy)]
struct Calls {
    divide: Handle<Function>,
    root: Handle<Function>,
}

/// The pass over one function.
struct Pass<'a> {
    info: &'a FunctionInfo,
    types: &'a UniqueArena<Type>,
    zero: (Handle<GlobalVariable>, u32),
    /// Nothing where quotients and roots stay what they are.
    calls: Option<Calls>,
}

/// A zero that the compiler does not know: a number, and vectors of two to four.
struct Zeros([Handle<Expression>; 4]);

impl Zeros {
    fn of(&self, size: Option<VectorSize>) -> Handle<Expression> {
        self.0[size.map_or(0, |size| size as usize - 1)]
    }
}

impl Pass<'_> {
    fn function(&self, mut function: Function) -> Result<Function, Refused> {
        let old = std::mem::take(&mut function.expressions);
        let mut new = Arena::new();
        let (zeros, preamble) = self.zeros(&mut new);
        let mut places: Vec<Place> = Vec::with_capacity(old.len());
        for (handle, expression) in old.iter() {
            let place = self.place(handle, expression, &places, &mut new, &zeros)?;
            places.push(place);
        }
        let at = |handle: Handle<Expression>| places[handle.index()].value();
        for (_, variable) in function.local_variables.iter_mut() {
            variable.init = variable.init.map(at);
        }
        function.named_expressions =
            function.named_expressions.drain(..).map(|(handle, name)| (at(handle), name)).collect();
        let mut body = Block::new();
        body.push(Statement::Emit(preamble), Span::default());
        body.extend_block(Body(&places).block(&function.body)?);
        function.body = body;
        function.expressions = new;
        Ok(function)
    }

    /// The zeros, and what evaluates them.
    fn zeros(&self, new: &mut Arena<Expression>) -> (Zeros, Range<Expression>) {
        let mut add = |expression| new.append(expression, Span::default());
        let uniform = add(Expression::GlobalVariable(self.zero.0));
        let bits = add(Expression::Literal(Literal::U32(31)));
        let pointer = add(Expression::AccessIndex { base: uniform, index: self.zero.1 });
        let member = add(Expression::Load { pointer });
        let zero = add(Expression::Binary { op: BinaryOperator::ShiftRight, left: member, right: bits });
        let sizes = [VectorSize::Bi, VectorSize::Tri, VectorSize::Quad];
        let [two, three, four] = sizes.map(|size| add(Expression::Splat { size, value: zero }));
        (Zeros([zero, two, three, four]), Range::new_from_bounds(pointer, four))
    }

    fn place(
        &self,
        handle: Handle<Expression>,
        expression: &Expression,
        places: &[Place],
        new: &mut Arena<Expression>,
        zeros: &Zeros,
    ) -> Result<Place, Refused> {
        let moved = moved(expression, |handle| places[handle.index()].value())?;
        let mut add = |expression| new.append(expression, Span::default());
        let shape = float(self.info[handle].ty.inner_with(self.types));
        let place = match (&moved, shape, self.calls) {
            (&Expression::Binary { op: BinaryOperator::Divide, left, right }, Some(None), Some(calls)) => {
                Place::Called(called(calls.divide, vec![left, right], &mut add))
            }
            (
                &Expression::Binary { op: BinaryOperator::Divide, left, right },
                Some(Some(size)),
                Some(calls),
            ) => {
                let ty = self.type_of(handle)?;
                let parts: Vec<_> = (0..size as u32)
                    .map(|index| [left, right].map(|base| add(Expression::AccessIndex { base, index })))
                    .collect();
                let calls: Vec<Call> =
                    parts.iter().map(|pair| called(calls.divide, pair.to_vec(), &mut add)).collect();
                let components = calls.iter().map(|call| call.result).collect();
                let value = add(Expression::Compose { ty, components });
                Place::Composed([parts[0][0], parts[parts.len() - 1][1]], calls, value)
            }
            (&Expression::Math { fun: MathFunction::Sqrt, arg, .. }, Some(None), Some(calls)) => {
                Place::Called(called(calls.root, vec![arg], &mut add))
            }
            (Expression::Binary { op, .. }, Some(size), calls) => {
                use BinaryOperator::{Add, Divide, Multiply, Subtract};
                let known = matches!(op, Add | Subtract | Multiply) || (*op == Divide && calls.is_none());
                if !known {
                    return Err(format!("{op:?} of numbers has no exact form"));
                }
                let first = add(moved);
                let bits = add(Expression::As { expr: first, kind: ScalarKind::Uint, convert: None });
                let same = add(Expression::Binary {
                    op: BinaryOperator::ExclusiveOr,
                    left: bits,
                    right: zeros.of(size),
                });
                let last = add(Expression::As { expr: same, kind: ScalarKind::Float, convert: None });
                Place::Evaluated(first, last)
            }
            (Expression::Math { fun, .. }, Some(_), calls) if !is_exact(*fun, calls.is_none()) => {
                return Err(format!("{fun:?} has no exact form"));
            }
            _ => {
                let only = add(moved);
                Place::Evaluated(only, only)
            }
        };
        Ok(place)
    }

    /// The type of an expression, which some variable or function has too.
    fn type_of(&self, handle: Handle<Expression>) -> Result<Handle<Type>, Refused> {
        let inner = self.info[handle].ty.inner_with(self.types);
        let mut types = self.types.iter();
        let found = types.find(|(_, ty)| ty.inner == *inner);
        found.map(|(handle, _)| handle).ok_or_else(|| format!("{inner:?} has no exact form"))
    }
}

/// Whether a function of WGSL gives the same number everywhere; inside the corrections, the root to correct is let through.
fn is_exact(fun: MathFunction, correcting: bool) -> bool {
    use MathFunction::{Abs, Ceil, Clamp, Floor, Max, Min, Round, Sign, Sqrt, Trunc};
    matches!(fun, Abs | Ceil | Clamp | Floor | Max | Min | Round | Sign | Trunc)
        || (correcting && fun == Sqrt)
}

/// The size of what holds floating-point numbers: none for a single one.
fn float(inner: &TypeInner) -> Option<Option<VectorSize>> {
    match inner {
        TypeInner::Scalar(scalar) if scalar.kind == ScalarKind::Float => Some(None),
        TypeInner::Vector { size, scalar } if scalar.kind == ScalarKind::Float => Some(Some(*size)),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
