//! The expressions of one part of a plant: a matrix, a vector or a number.

use super::error::{CellFault, CellProblem, FamilyError, Place};
use super::expression::Expression;
use super::parameter::{Parameter, ParameterId, named};
use super::table::Item;

/// The expressions of a matrix row by row, of a vector, or of one number, each with its place.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub place: Place,
    entries: Vec<(Place, Expression)>,
}

const EXPRESSION: &str = "an expression in quotes, or a number";
const LIST: &str = r#"a list of expressions, one for each coordinate: ["1", "0"]"#;
const ROWS: &str = r#"a list of rows, one for each coordinate: [["1", "0"], ["0", "1"]]"#;

impl Block {
    fn new(item: &Item, entries: &[Item], parameters: &[String]) -> Result<Self, FamilyError> {
        let compiled = entries.iter().map(|entry| Ok((entry.place(), expression(entry, parameters)?)));
        Ok(Block { place: item.place(), entries: compiled.collect::<Result<_, _>>()? })
    }

    pub fn scalar(item: &Item, parameters: &[String]) -> Result<Self, FamilyError> {
        Self::new(item, std::slice::from_ref(item), parameters)
    }

    pub fn vector(item: &Item, n: usize, parameters: &[String]) -> Result<Self, FamilyError> {
        let entries = item.list(LIST)?;
        check_count(item, "entries", entries.len(), n)?;
        Self::new(item, &entries, parameters)
    }

    pub fn matrix(item: &Item, n: usize, parameters: &[String]) -> Result<Self, FamilyError> {
        let rows = item.list(ROWS)?;
        check_count(item, "rows", rows.len(), n)?;
        let mut entries = Vec::with_capacity(n * n);
        for row in &rows {
            let row_entries = row.list(ROWS)?;
            check_count(row, "entries", row_entries.len(), n)?;
            entries.extend(row_entries);
        }
        Self::new(item, &entries, parameters)
    }

    /// The rows of a matrix, whatever their number.
    pub fn rows(item: &Item) -> Result<usize, FamilyError> {
        Ok(item.list(ROWS)?.len())
    }

    /// A vector or a number that the file leaves out.
    pub fn zeros(place: Place, n: usize) -> Self {
        Block { entries: vec![(place.clone(), Expression::number(0.0)); n], place }
    }

    /// The parameters that the expressions name, some of them more than once.
    pub fn uses(&self) -> impl Iterator<Item = ParameterId> {
        self.entries.iter().flat_map(|(_, expression)| expression.uses())
    }

    /// The expressions as they are written, in the order of the file.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|(_, expression)| expression.text())
    }

    /// The first number, if it has a value where a family's parameters have some values.
    pub fn number(&self, values: &[f64]) -> Option<f64> {
        self.entries.first().and_then(|(_, expression)| expression.value(values).ok())
    }

    /// Puts the numbers into their places, in the order of the file: those where a family's parameters have some values.
    ///
    /// # Errors
    /// The first expression that has no value, with its place and the values that it names.
    pub fn evaluate(
        &self,
        parameters: &[Parameter],
        values: &[f64],
        places: &mut [f64],
    ) -> Result<(), Box<CellFault>> {
        debug_assert_eq!(places.len(), self.entries.len(), "{}", self.place);
        for (number, (place, expression)) in places.iter_mut().zip(&self.entries) {
            *number = expression.evaluate(values).map_err(|fault| {
                let named = named(parameters, expression.uses(), values);
                let problem = CellProblem::Expression(fault);
                Box::new(CellFault { place: place.clone(), problem, values: named })
            })?;
        }
        Ok(())
    }
}

fn expression(item: &Item, parameters: &[String]) -> Result<Expression, FamilyError> {
    if let Some(number) = item.bare_number() {
        return number.map(Expression::number);
    }
    let compiled = Expression::compile(item.text(EXPRESSION)?, parameters);
    compiled.map_err(|error| item.error(error.to_string()))
}

fn check_count(item: &Item, what: &'static str, found: usize, wanted: usize) -> Result<(), FamilyError> {
    if found == wanted {
        return Ok(());
    }
    let problem = format!(
        "{found} {what} where {wanted} should be: system.mass has {wanted} rows, one for each coordinate"
    );
    Err(item.error(problem))
}
