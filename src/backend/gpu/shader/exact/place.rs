//! Where the expressions of a function are once its arithmetic is exact.

use naga::{Expression, Function, Handle, Statement};

/// Why a kernel cannot be computed exactly.
pub type Refused = String;

/// What became of an expression.
pub enum Place {
    /// It is evaluated by these, the last of which is its value.
    Evaluated(Handle<Expression>, Handle<Expression>),
    /// It is what a function gives.
    Called(Call),
    /// It is a vector of what a function gives for the components of others: those, the calls, and the vector.
    Composed([Handle<Expression>; 2], Vec<Call>, Handle<Expression>),
}

/// A call of a function, and what it gives.
#[derive(Clone)]
pub struct Call {
    pub function: Handle<Function>,
    pub arguments: Vec<Handle<Expression>>,
    pub result: Handle<Expression>,
}

impl Call {
    /// The statement that makes it.
    pub fn statement(&self) -> Statement {
        let Call { function, arguments, result } = self.clone();
        Statement::Call { function, arguments, result: Some(result) }
    }
}

impl Place {
    /// What stands for the expression.
    pub fn value(&self) -> Handle<Expression> {
        match self {
            Place::Evaluated(_, value) | Place::Composed(_, _, value) => *value,
            Place::Called(call) => call.result,
        }
    }
}

/// A call of a function with so many arguments.
pub fn called(
    function: Handle<Function>,
    arguments: Vec<Handle<Expression>>,
    add: &mut impl FnMut(Expression) -> Handle<Expression>,
) -> Call {
    Call { function, arguments, result: add(Expression::CallResult(function)) }
}
