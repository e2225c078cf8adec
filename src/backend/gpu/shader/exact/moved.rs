//! Expressions whose operands have moved.

use naga::{Expression, Handle};

use super::place::Refused;

/// An expression whose operands have moved.
pub fn moved(
    expression: &Expression,
    at: impl Fn(Handle<Expression>) -> Handle<Expression>,
) -> Result<Expression, Refused> {
    use Expression as E;
    Ok(match *expression {
        E::Literal(_) | E::Constant(_) | E::ZeroValue(_) | E::FunctionArgument(_) => expression.clone(),
        E::GlobalVariable(_) | E::LocalVariable(_) | E::CallResult(_) => expression.clone(),
        E::Compose { ty, ref components } => {
            E::Compose { ty, components: components.iter().map(|&part| at(part)).collect() }
        }
        E::Access { base, index } => E::Access { base: at(base), index: at(index) },
        E::AccessIndex { base, index } => E::AccessIndex { base: at(base), index },
        E::Splat { size, value } => E::Splat { size, value: at(value) },
        E::Swizzle { size, vector, pattern } => E::Swizzle { size, vector: at(vector), pattern },
        E::Load { pointer } => E::Load { pointer: at(pointer) },
        E::Unary { op, expr } => E::Unary { op, expr: at(expr) },
        E::Binary { op, left, right } => E::Binary { op, left: at(left), right: at(right) },
        E::Select { condition, accept, reject } => {
            E::Select { condition: at(condition), accept: at(accept), reject: at(reject) }
        }
        E::Relational { fun, argument } => E::Relational { fun, argument: at(argument) },
        E::Math { fun, arg, arg1, arg2, arg3 } => {
            E::Math { fun, arg: at(arg), arg1: arg1.map(&at), arg2: arg2.map(&at), arg3: arg3.map(&at) }
        }
        E::As { expr, kind, convert } => E::As { expr: at(expr), kind, convert },
        ref other => return Err(format!("{other:?} has no exact form")),
    })
}
