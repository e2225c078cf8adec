//! The bifurcation diagram along a line through a plane.

use crate::diagram::Diagram;
use crate::figure::{Figure, Text, number};
use crate::plane::Quantity;
use crate::render::diagram::diagram_figure;
use crate::render::symbol::symbol;
use crate::render::symbols;

/// A diagram whose columns lie on a line through a plane, drawn over the quantity of its axis while another one goes from
/// one value to another too, which the title says.
pub fn slice_figure(diagram: &Diagram, other: Quantity, [from, to]: [f64; 2]) -> Figure {
    let mut figure = diagram_figure(diagram);
    let spec = &diagram.spec;
    let varied = |quantity| quantity == spec.x.quantity || quantity == other;
    let ends = format!(" = {} … {},", number(from), number(to));
    let along: Vec<Text> = vec![symbol(other).upright(ends)];
    let fixed = symbols::equations(&spec.parameters, varied);
    let before = symbols::equations(&spec.parameters, |quantity| quantity == spec.x.quantity).len();
    let beginning = figure.title.split_off(before.min(figure.title.len()));
    figure.title = along.into_iter().chain(fixed).chain(beginning).collect();
    figure
}
