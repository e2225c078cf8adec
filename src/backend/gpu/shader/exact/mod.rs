//! Arithmetic that no driver changes: a pass over a kernel after which every sum, difference, product, quotient and square root
//! is rounded as IEEE 754 asks, in the order of the source.
//!
//! WGSL lets a driver contract a product and a sum, reorder what it takes for equal, and divide to within 2.5 units in the
//! last place. Here the result of every operation is read as bits, combined with a zero that only the running kernel knows,
//! and read as a number again: what lies on the two sides cannot be merged. Quotients and square roots become calls of
//! functions that correct what the driver gives (`shaders/shared/exact.wgsl`).

use naga::valid::{Capabilities, FunctionInfo, ValidationFlags, Validator};
use naga::{
    Arena, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, Literal, MathFunction,
    Module, Range, ScalarKind, Span, Statement, SwitchCase, Type, TypeInner, UniqueArena, VectorSize,
};

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
            Arithmetic::Exact => include_str!("../../../../shaders/shared/exact.wgsl"),
        }
    }
}

/// What quotients and square roots become calls of; they are left alone themselves.
const DIVIDE: &str = "exact_quotient";
const ROOT: &str = "exact_root";

/// The uniform, and its member of type u32 that is 0 or 1, from which the zero is made.
const UNIFORM: (&str, &str) = ("dispatch", "begin");

/// Why a kernel cannot be computed exactly.
pub type Refused = String;

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

/// What became of an expression.
enum Place {
    /// It is evaluated by these, the last of which is its value.
    Evaluated(Handle<Expression>, Handle<Expression>),
    /// It is what a function gives.
    Called(Call),
    /// It is a vector of what a function gives for the components of others: those, the calls, and the vector.
    Composed([Handle<Expression>; 2], Vec<Call>, Handle<Expression>),
}

/// A call of a function, and what it gives.
#[derive(Clone)]
struct Call {
    function: Handle<Function>,
    arguments: Vec<Handle<Expression>>,
    result: Handle<Expression>,
}

impl Call {
    fn statement(&self) -> Statement {
        let Call { function, arguments, result } = self.clone();
        Statement::Call { function, arguments, result: Some(result) }
    }
}

impl Place {
    fn value(&self) -> Handle<Expression> {
        match self {
            Place::Evaluated(_, value) | Place::Composed(_, _, value) => *value,
            Place::Called(call) => call.result,
        }
    }
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
        E::As { expr, kind, convert } => E::As { expr: at(expr), kind, convert },
        ref other => return Err(format!("{other:?} has no exact form")),
    })
}

/// The statements of a function over the expressions' places.
struct Body<'a>(&'a [Place]);

impl Body<'_> {
    fn at(&self, handle: Handle<Expression>) -> Handle<Expression> {
        self.0[handle.index()].value()
    }

    fn block(&self, old: &Block) -> Result<Block, Refused> {
        let mut block = Block::new();
        for (statement, &span) in old.span_iter() {
            if let Statement::Emit(range) = statement {
                self.emit(range.clone(), span, &mut block);
            } else {
                block.push(self.statement(statement)?, span);
            }
        }
        Ok(block)
    }

    /// Evaluates what was evaluated together, with the calls where they are due.
    fn emit(&self, range: Range<Expression>, span: Span, block: &mut Block) {
        let mut open: Option<(Handle<Expression>, Handle<Expression>)> = None;
        let close = |open: &mut Option<_>, block: &mut Block| {
            if let Some((first, last)) = open.take() {
                block.push(Statement::Emit(Range::new_from_bounds(first, last)), span);
            }
        };
        for handle in range {
            match &self.0[handle.index()] {
                Place::Evaluated(first, last) => {
                    open = Some((open.map_or(*first, |(first, _)| first), *last));
                }
                Place::Called(call) => {
                    close(&mut open, block);
                    block.push(call.statement(), span);
                }
                Place::Composed([first, last], calls, value) => {
                    open = Some((open.map_or(*first, |(first, _)| first), *last));
                    close(&mut open, block);
                    for call in calls {
                        block.push(call.statement(), span);
                    }
                    open = Some((*value, *value));
                }
            }
        }
        close(&mut open, block);
    }

    fn statement(&self, statement: &Statement) -> Result<Statement, Refused> {
        use Statement as S;
        Ok(match statement {
            S::Break | S::Continue => statement.clone(),
            S::Block(block) => S::Block(self.block(block)?),
            S::If { condition, accept, reject } => S::If {
                condition: self.at(*condition),
                accept: self.block(accept)?,
                reject: self.block(reject)?,
            },
            S::Switch { selector, cases } => {
                let case = |case: &SwitchCase| {
                    let SwitchCase { value, fall_through, .. } = *case;
                    Ok(SwitchCase { value, body: self.block(&case.body)?, fall_through })
                };
                let cases = cases.iter().map(case).collect::<Result<_, Refused>>()?;
                S::Switch { selector: self.at(*selector), cases }
            }
            S::Loop { body, continuing, break_if } => S::Loop {
                body: self.block(body)?,
                continuing: self.block(continuing)?,
                break_if: break_if.map(|handle| self.at(handle)),
            },
            S::Return { value } => S::Return { value: value.map(|handle| self.at(handle)) },
            S::Store { pointer, value } => S::Store { pointer: self.at(*pointer), value: self.at(*value) },
            S::Call { function, arguments, result } => S::Call {
                function: *function,
                arguments: arguments.iter().map(|&argument| self.at(argument)).collect(),
                result: result.map(|handle| self.at(handle)),
            },
            other => return Err(format!("{other:?} has no exact form")),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A kernel that computes something from two numbers.
    fn kernel(what: &str) -> String {
        let begin =
            "struct Dispatch { begin: u32 }\n@group(0) @binding(0) var<uniform> dispatch: Dispatch;\n";
        let out = "@group(0) @binding(1) var<storage, read_write> out: array<f32>;\n";
        let main =
            format!("@compute @workgroup_size(1) fn main() {{ let a = out[0]; let b = out[1]; {what} }}");
        [Arithmetic::Exact.source(), begin, out, &main].concat()
    }

    /// How many expressions of an entry point are combined with the zero, and how many functions it calls.
    fn counts(what: &str) -> (usize, usize) {
        let module = exact(&kernel(what)).unwrap();
        let function = &module.entry_points[0].function;
        let is_guard = |expression: &&Expression| {
            matches!(expression, Expression::Binary { op: BinaryOperator::ExclusiveOr, .. })
        };
        let guards = function.expressions.iter().map(|(_, expression)| expression).filter(is_guard).count();
        let calls =
            function.body.iter().filter(|statement| matches!(statement, Statement::Call { .. })).count();
        (guards, calls)
    }

    #[test]
    fn every_operation_is_guarded_or_called() {
        assert_eq!(counts("out[0] = a * b + a;"), (2, 0));
        assert_eq!(counts("out[0] = a / b - sqrt(a);"), (1, 2));
        assert_eq!(counts("out[0] = max(abs(a), -b);"), (0, 0));
        assert_eq!(counts("let v = vec3<f32>(a, b, a) * 2.0; out[0] = v.x;"), (1, 0));
        assert_eq!(counts("let v = vec3<f32>(a, b, a) / vec3<f32>(b); out[0] = v.x;"), (0, 3));
        assert_eq!(counts("out[u32(a) + 1u] = b;"), (0, 0));
    }

    #[test]
    fn what_has_no_exact_form_is_refused() {
        for what in ["sin(a)", "fma(a, b, a)", "dot(vec2<f32>(a, b), vec2<f32>(b, a))", "a % b", "log(a)"] {
            let refused = exact(&kernel(&format!("out[0] = {what};"))).unwrap_err();
            assert!(refused.contains("has no exact form"), "{what}: {refused}");
        }
    }
}
