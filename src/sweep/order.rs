//! The order in which the cells of a plane are computed.

use std::ops::Range;

use crate::plane::{Axis, Plane, Quantity};

/// An order of the cells of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Order {
    columns: u64,
    rows: u64,
    /// Column by column, or else row by row.
    by_column: bool,
}

impl Order {
    /// The one in which cells that have their flow in common come one after the other: column by column where the flow varies
    /// from left to right alone, else row by row.
    pub fn by_flow<T>(plane: &Plane<T>) -> Self {
        let by_column = varies_flow(&plane.x) && !varies_flow(&plane.y);
        Order { columns: plane.x.count.into(), rows: plane.y.count.into(), by_column }
    }

    /// The cells at some places of the order, counted row by row.
    pub fn cells(self, places: Range<u64>) -> impl Iterator<Item = u64> {
        places.map(move |place| match self.by_column {
            true => place % self.rows * self.columns + place / self.rows,
            false => place,
        })
    }

    /// The place of a cell, counted row by row, in the order.
    pub fn place(self, cell: u64) -> u64 {
        match self.by_column {
            true => cell % self.columns * self.rows + cell / self.columns,
            false => cell,
        }
    }
}

/// Whether cells along an axis have different flows.
fn varies_flow(axis: &Axis) -> bool {
    matches!(axis.quantity, Quantity::Parameter(parameter) if parameter.is_of_flow())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::Start;

    #[test]
    fn cells_with_the_same_flow_come_one_after_the_other() {
        for (x, y, by_column) in [
            ("omega=2:4:9", "delta=0.05:0.3:31", true),
            ("delta=0.05:0.3:31", "omega=2:4:9", false),
            ("omega=2:4:9", "zeta=0.05:0.3:31", false),
            ("v1=-1:1:9", "delta=0.05:0.3:31", false),
        ] {
            let plane = Plane::of_paper(x, y, Start::State([0.0; 4].into()), ()).unwrap();
            let order = Order::by_flow(&plane);
            assert_eq!(order.by_column, by_column, "{x}, {y}");
            let cells: Vec<u64> = order.cells(0..plane.cells()).collect();
            for (place, &cell) in cells.iter().enumerate() {
                assert_eq!(order.place(cell), place as u64, "{x}, {y}: each cell once, and back");
            }
            let omega = |cell: u64| {
                let columns = u64::from(plane.x.count);
                plane.parameters_at((cell % columns) as u32, (cell / columns) as u32).named("omega")
            };
            let changes = cells.windows(2).filter(|pair| omega(pair[0]) != omega(pair[1])).count();
            let fewest = usize::from(x.contains("omega") || y.contains("omega")) * 8;
            assert_eq!(changes == fewest, by_column || !x.contains("omega"), "{x}, {y}: {changes}");
        }
    }
}
