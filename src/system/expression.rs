//! Expressions in the parameters, compiled once and evaluated in every cell.

use std::cell::RefCell;
use std::collections::BTreeMap;

use nanoexpr::{Context, ErrorKind, Evaluator, Instruction, Math, Number, Program, Span};
use parking_lot::Mutex;
use thiserror::Error;

use super::parameter::ParameterId;

/// An expression in the parameters of a family.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    text: String,
    form: Form,
    /// The parameters that it names, each once.
    uses: Vec<(String, ParameterId)>,
}

#[derive(Clone, Copy, Debug)]
enum Form {
    Constant(f64),
    Parameter(ParameterId),
    Formula(Formula),
}

type Formula = Program<'static, 'static, f64>;

/// Every formula that was compiled. A program borrows its text and its code: each different formula is kept for as
/// long as the process lives, once.
static FORMULAS: Mutex<BTreeMap<&'static str, Formula>> = Mutex::new(BTreeMap::new());

/// Why a text is no expression in the parameters, and what to write.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{0}")]
pub struct ExpressionError(String);

impl From<Fault> for ExpressionError {
    fn from(fault: Fault) -> Self {
        ExpressionError(format!("{fault}: correct it"))
    }
}

/// Why an expression has no value.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("`{piece}` {reason}{}", if piece == text { String::new() } else { format!(" in `{text}`") })]
pub struct Fault {
    /// The expression.
    pub text: String,
    /// The part of it that has no value.
    pub piece: String,
    /// Why.
    pub reason: &'static str,
}

impl Expression {
    /// A number.
    pub fn number(value: f64) -> Self {
        Expression { text: value.to_string(), form: Form::Constant(value), uses: Vec::new() }
    }

    /// The expression as it is written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Compiles a text that may name these parameters, in their order.
    ///
    /// # Errors
    /// Whatever keeps the text from being an expression, and a constant one without a value.
    pub fn compile(text: &str, parameters: &[String]) -> Result<Self, ExpressionError> {
        let uses = names(text, parameters)?;
        let form = match &uses[..] {
            [(name, id)] if name == text.trim() => Form::Parameter(*id),
            _ => Form::Formula(formula(text)?),
        };
        let mut expression = Expression { text: text.to_owned(), form, uses };
        if expression.uses.is_empty() {
            expression.form = Form::Constant(expression.evaluate(&[])?);
        }
        Ok(expression)
    }

    /// The value, given those of the parameters in their order; finite where they are.
    ///
    /// # Errors
    /// [`Fault`] names the part that divides by zero, is no real number or is too large.
    pub fn evaluate(&self, values: &[f64]) -> Result<f64, Fault> {
        self.value(values).map_err(|error| self.fault(error.kind, error.span))
    }

    /// The same, with what is wrong not yet in words.
    pub fn value(&self, values: &[f64]) -> Result<f64, nanoexpr::Error> {
        match self.form {
            Form::Constant(value) => Ok(value),
            Form::Parameter(id) => Ok(values[id.0]),
            Form::Formula(program) => program.evaluate(&Scope { uses: &self.uses, values }),
        }
    }

    /// The parameters that it names.
    pub fn uses(&self) -> impl Iterator<Item = ParameterId> {
        self.uses.iter().map(|(_, id)| *id)
    }

    fn fault(&self, kind: ErrorKind, span: Span) -> Fault {
        let reason = match kind {
            ErrorKind::DivisionByZero => "divides by zero",
            ErrorKind::Domain => "is not a number (NaN)",
            ErrorKind::Overflow => "is too large a number",
            other => other.description(),
        };
        Fault { text: self.text.clone(), piece: self.text[span.start..span.end].to_owned(), reason }
    }
}

/// The value of π, the one constant; everything else that is named is a parameter.
fn constant(name: &str) -> Option<f64> {
    (name == "pi").then_some(std::f64::consts::PI)
}

/// Whether a name has a meaning of its own in expressions.
pub(super) fn has_meaning(name: &str) -> bool {
    let function = Context::<f64>::call(&Math, name, &[]).is_some();
    constant(name).is_some() || name == "mod" || function
}

/// The parameters' values by name.
struct Scope<'a> {
    uses: &'a [(String, ParameterId)],
    values: &'a [f64],
}

impl Context<f64> for Scope<'_> {
    fn variable(&self, name: &str) -> Option<f64> {
        let parameter = self.uses.iter().find(|(used, _)| used == name);
        parameter.map(|(_, id)| self.values[id.0]).or_else(|| constant(name))
    }

    fn call(&self, name: &str, arguments: &[f64]) -> Option<Result<f64, ErrorKind>> {
        Math.call(name, arguments)
    }
}

fn formula(text: &str) -> Result<Formula, ExpressionError> {
    let mut formulas = FORMULAS.lock();
    if let Some(formula) = formulas.get(text) {
        return Ok(*formula);
    }
    // No instruction is of less than one character, but for the end of a comparison, which is refused before.
    let code = vec![Instruction::default(); text.len()].leak();
    let text: &'static str = text.to_owned().leak();
    let formula = nanoexpr::compile(text, code).map_err(|error| syntax(text, error.kind, error.span))?;
    formulas.insert(text, formula);
    Ok(formula)
}

fn syntax(text: &str, kind: ErrorKind, span: Span) -> ExpressionError {
    let at = text[..span.start].chars().count() + 1;
    let reason = kind.description();
    ExpressionError(format!(
        "`{text}` is not an expression, {reason} at character {at}: write one such as 2*zeta/(1 - mu)"
    ))
}

/// A value of which only the name matters: everything can be computed with it but a comparison.
#[derive(Clone, Copy, Default)]
struct Symbol;

impl Number for Symbol {
    fn parse(literal: &str) -> Option<Self> {
        f64::parse(literal).map(|_| Symbol)
    }

    fn add(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(self)
    }

    fn subtract(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(self)
    }

    fn multiply(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(self)
    }

    fn divide(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(self)
    }

    fn remainder(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(self)
    }

    fn power(self, _: Self) -> Result<Self, ErrorKind> {
        Ok(self)
    }

    fn negate(self) -> Result<Self, ErrorKind> {
        Ok(self)
    }
}

/// Takes note of the parameters that an expression names.
struct Names<'a> {
    parameters: &'a [String],
    found: RefCell<Vec<(String, ParameterId)>>,
}

impl Context<Symbol> for Names<'_> {
    fn variable(&self, name: &str) -> Option<Symbol> {
        if let Some(index) = self.parameters.iter().position(|parameter| parameter == name) {
            let mut found = self.found.borrow_mut();
            if found.iter().all(|(other, _)| other != name) {
                found.push((name.to_owned(), ParameterId(index)));
            }
            return Some(Symbol);
        }
        constant(name).map(|_| Symbol)
    }

    fn call(&self, name: &str, arguments: &[Symbol]) -> Option<Result<Symbol, ErrorKind>> {
        let arguments = vec![0.5; arguments.len()];
        Math.call(name, &arguments).map(|result| match result {
            Err(ErrorKind::ArgumentCount) => Err(ErrorKind::ArgumentCount),
            _ => Ok(Symbol),
        })
    }
}

/// The parameters that a text names, in the order of the text.
fn names(text: &str, parameters: &[String]) -> Result<Vec<(String, ParameterId)>, ExpressionError> {
    let names = Names { parameters, found: RefCell::default() };
    let Err(nanoexpr::Error { kind, span }) = Evaluator::<_>::new(&names).evaluate::<Symbol>(text) else {
        return Ok(names.found.into_inner());
    };
    let piece = &text[span.start..span.end];
    Err(ExpressionError(match kind {
        ErrorKind::UnknownVariable => {
            let known = parameters.join(", ");
            format!(
                "`{piece}` in `{text}` is not a parameter: add it to [parameters], or write one of {known}"
            )
        }
        ErrorKind::UnknownFunction => format!(
            "`{piece}` in `{text}` is not a function: sqrt, exp, ln, sin, cos, tan, abs, min, max and others are; a \
             product needs its *"
        ),
        ErrorKind::ArgumentCount | ErrorKind::TooManyArguments => format!(
            "`{piece}` in `{text}` has the wrong number of arguments: give it as many as the function takes"
        ),
        ErrorKind::Unsupported => format!(
            "`{text}` compares: expressions are smooth pieces made of + - * / ^ and functions; abs, min and max join them"
        ),
        _ => return Err(syntax(text, kind, span)),
    }))
}
