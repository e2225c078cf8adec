//! The pass over the expressions of one function.

use naga::valid::FunctionInfo;
use naga::{
    Arena, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, Literal, MathFunction, Range,
    ScalarKind, Span, Statement, Type, TypeInner, UniqueArena, VectorSize,
};

use super::body::Body;
use super::place::{Call, Place};
use super::refused::Refused;

/// The functions that are called for quotients and square roots.
#[derive(Clone, Copy)]
pub(super) struct Calls {
    pub divide: Handle<Function>,
    pub root: Handle<Function>,
}

/// The pass over one function.
pub(super) struct Pass<'a> {
    pub info: &'a FunctionInfo,
    pub types: &'a UniqueArena<Type>,
    pub zero: (Handle<GlobalVariable>, u32),
    /// Nothing where quotients and roots stay what they are.
    pub calls: Option<Calls>,
}

/// A zero that the compiler does not know: a number, and vectors of two to four.
struct Zeros([Handle<Expression>; 4]);

impl Zeros {
    fn of(&self, size: Option<VectorSize>) -> Handle<Expression> {
        self.0[size.map_or(0, |size| size as usize - 1)]
    }
}

impl Pass<'_> {
    pub fn function(&self, mut function: Function) -> Result<Function, Refused> {
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
        let dispatch = add(Expression::GlobalVariable(self.zero.0));
        let bits = add(Expression::Literal(Literal::U32(31)));
        let pointer = add(Expression::AccessIndex { base: dispatch, index: self.zero.1 });
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

/// A call of a function with so many arguments.
fn called(
    function: Handle<Function>,
    arguments: Vec<Handle<Expression>>,
    add: &mut impl FnMut(Expression) -> Handle<Expression>,
) -> Call {
    Call { function, arguments, result: add(Expression::CallResult(function)) }
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

/// An expression whose operands have moved.
fn moved(
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
        E::ArrayLength(array) => E::ArrayLength(at(array)),
        E::As { expr, kind, convert } => E::As { expr: at(expr), kind, convert },
        ref other => return Err(format!("{other:?} has no exact form")),
    })
}
