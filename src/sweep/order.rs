//! The order in which the cells of a plane are computed.

use std::ops::Range;

use crate::plane::{Axis, Plane, Quantity};

/// The golden ratio's inverse, whose multiples are spread evenly by their fractions.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// An order of the cells of a plane in which those that have their flow in common come one after the other, and of those the
/// ones that have their restitutions in common.
#[derive(Clone, Debug)]
pub(super) struct Order {
    columns: u64,
    rows: u64,
    /// The columns one after the other, where the order goes by them; none row by row.
    by_column: Option<Vec<u32>>,
}

impl Order {
    /// Of the cells of a plane.
    ///
    /// Columns next to each other are as dear as each other: they come far apart, so that all parts of the order take as long.
    pub fn by_flow<T>(plane: &Plane<T>) -> Self {
        let columns = plane.x.count;
        let by_column = goes_by_column(plane).then(|| {
            let share = |&column: &u32| (f64::from(column) * GOLDEN).fract();
            let mut spread: Vec<u32> = (0..columns).collect();
            spread.sort_by(|a, b| share(a).total_cmp(&share(b)));
            spread
        });
        Order { columns: columns.into(), rows: plane.y.count.into(), by_column }
    }

    /// The cells at some places of the order, counted row by row.
    pub fn cells(&self, places: Range<u64>) -> impl Iterator<Item = u64> {
        places.map(|place| self.cell(place))
    }

    /// The numbers, among the cells at some places of the order, of those in a row.
    pub fn numbers_in(&self, row: u64, places: &Range<u64>) -> impl Iterator<Item = usize> {
        let (begin, end) = (places.start, places.end);
        let (first, end, stride) = match self.by_column {
            Some(_) => (begin + (row + self.rows - begin % self.rows) % self.rows, end, self.rows),
            None => (begin.max(row * self.columns), end.min((row + 1) * self.columns), 1),
        };
        (first..end).step_by(stride as usize).map(move |place| (place - begin) as usize)
    }

    /// The cell at a place.
    fn cell(&self, place: u64) -> u64 {
        match &self.by_column {
            Some(columns) => {
                place % self.rows * self.columns + u64::from(columns[(place / self.rows) as usize])
            }
            None => place,
        }
    }
}

/// Whether cells above each other have more in common than cells beside each other.
pub(super) fn goes_by_column<T>(plane: &Plane<T>) -> bool {
    Varied::along(&plane.x) > Varied::along(&plane.y)
}

/// Whether no two cells of a plane have their flow in common.
pub(super) fn has_flows_by_cell<T>(plane: &Plane<T>) -> bool {
    [&plane.x, &plane.y].map(Varied::along) == [Varied::Flow; 2]
}

/// In what cells along an axis differ; what of it is found once for all of them is the less, the later it comes here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Varied {
    /// Gaps, starts or how they are controlled.
    Gaps,
    /// Restitutions.
    Restitutions,
    /// More than stops.
    Flow,
}

impl Varied {
    fn along(axis: &Axis) -> Self {
        match axis.quantity {
            Quantity::Parameter(parameter) if parameter.is_of_flow() => Varied::Flow,
            Quantity::Parameter(parameter) if parameter.is_of_restitution() => Varied::Restitutions,
            _ => Varied::Gaps,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::Start;

    /// Whether the order goes by columns.
    const PLANES: [(&str, &str, bool); 7] = [
        ("omega=2:4:9", "r=0.3:0.9:31", true),
        ("r=0.3:0.9:31", "omega=2:4:9", false),
        ("r=0.3:0.9:31", "delta=0.05:0.3:9", true),
        ("omega=2:4:9", "delta=0.05:0.3:31", true),
        ("delta=0.05:0.3:31", "omega=2:4:9", false),
        ("omega=2:4:9", "zeta=0.05:0.3:31", false),
        ("v1=-1:1:9", "delta=0.05:0.3:31", false),
    ];

    fn plane(x: &str, y: &str) -> Plane<()> {
        Plane::of_paper(x, y, Start::State([0.0; 4].into()), ()).unwrap()
    }

    #[test]
    fn cells_that_have_more_in_common_come_one_after_the_other() {
        for (x, y, by_column) in PLANES {
            let plane = plane(x, y);
            let order = Order::by_flow(&plane);
            assert_eq!(order.by_column.is_some(), by_column, "{x}, {y}");
            assert_eq!(has_flows_by_cell(&plane), x.contains("omega") && y.contains("zeta"), "{x}, {y}");
            let cells: Vec<u64> = order.cells(0..plane.cells()).collect();
            let mut sorted = cells.clone();
            sorted.sort_unstable();
            assert!(sorted.into_iter().eq(0..plane.cells()), "{x}, {y}: each cell once");
            let changes = |name: &str| {
                let columns = u64::from(plane.x.count);
                let value = |cell: u64| {
                    plane.parameters_at((cell % columns) as u32, (cell / columns) as u32).named(name)
                };
                cells.windows(2).filter(|pair| value(pair[0]) != value(pair[1])).count()
            };
            if [x, y].iter().all(|axis| !axis.contains("omega")) && x.contains("r=") {
                assert_eq!(changes("r"), 30, "{x}, {y}");
                assert!(changes("delta") > 30, "{x}, {y}: the check can fail");
            }
            let changes = changes("omega");
            match (x.contains("omega"), by_column) {
                (true, true) => assert_eq!(changes, 8, "{x}, {y}"),
                (true, false) => assert!(changes > 8, "{x}, {y}: the check can fail"),
                (false, _) => assert_eq!(changes, if y.contains("omega") { 8 } else { 0 }, "{x}, {y}"),
            }
        }
    }

    #[test]
    fn every_row_has_its_own_cells() {
        for (x, y, by_column) in PLANES {
            let plane = plane(x, y);
            let (order, cells) = (Order::by_flow(&plane), plane.cells());
            for places in [0..cells, 0..1, 7..50, 40..cells, 5..5] {
                let direct: Vec<u64> = order.cells(places.clone()).collect();
                let row_of = |number: usize| direct[number] / u64::from(plane.x.count);
                let mut all = Vec::new();
                for row in 0..u64::from(plane.y.count) {
                    let numbers: Vec<usize> = order.numbers_in(row, &places).collect();
                    assert!(numbers.iter().all(|&number| row_of(number) == row), "{x}, {y}: {places:?}");
                    all.extend(numbers);
                }
                let is_long = places == (0..cells);
                assert!(!(is_long && by_column && all.is_sorted()), "the check can fail");
                all.sort_unstable();
                assert!(all.into_iter().eq(0..direct.len()), "{x}, {y}: {places:?}");
            }
        }
    }

    #[test]
    fn every_part_of_the_order_has_columns_from_everywhere() {
        let plane = plane("omega=0.5:4.4:800", "delta=0.05:0.3:31");
        let order = Order::by_flow(&plane);
        let part = plane.cells() / 16;
        for i in 0..16 {
            let columns: Vec<u64> = order.cells(i * part..(i + 1) * part).map(|cell| cell % 800).collect();
            let mean = columns.iter().sum::<u64>() as f64 / columns.len() as f64;
            assert!((mean - 400.0).abs() < 40.0, "{mean} in part {i}");
            for quarter in 0..4 {
                let there = columns.iter().filter(|&column| column / 200 == quarter).count();
                assert!(5 * there > columns.len(), "{there} of {} in quarter {quarter}", columns.len());
            }
        }
    }
}
