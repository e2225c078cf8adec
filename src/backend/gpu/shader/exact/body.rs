//! The statements of a function whose arithmetic is exact.

use naga::{Block, Expression, Handle, Range, Span, Statement, SwitchCase};

use super::place::{Place, Refused};

/// The statements of a function over the expressions' places.
pub struct Body<'a>(pub &'a [Place]);

impl Body<'_> {
    fn at(&self, handle: Handle<Expression>) -> Handle<Expression> {
        self.0[handle.index()].value()
    }

    /// A block of them.
    pub fn block(&self, old: &Block) -> Result<Block, Refused> {
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
