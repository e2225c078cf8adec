//! Some of the cells of a rectangle, spread evenly over it.

use std::ops::Range;

/// Cells of so many of some columns and rows at most, from the first to the last of each; all of a small rectangle. Row by row.
pub(super) fn some_cells(
    columns: Range<u32>,
    rows: Range<u32>,
    most: u32,
) -> impl Iterator<Item = (u32, u32)> {
    along(rows, most).flat_map(move |row| along(columns.clone(), most).map(move |column| (column, row)))
}

fn along(range: Range<u32>, most: u32) -> impl Iterator<Item = u32> {
    let count = u64::from(range.end - range.start);
    let shown = count.min(u64::from(most));
    (0..shown).map(move |i| range.start + (i * count.saturating_sub(1) / (shown - 1).max(1)) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_rectangle_is_there_whole_and_of_a_large_one_its_corners() {
        let of = |columns, rows, most| some_cells(columns, rows, most).collect::<Vec<_>>();
        assert_eq!(of(3..5, 7..9, 4), [(3, 7), (4, 7), (3, 8), (4, 8)]);
        let large = of(0..1000, 5..77, 4);
        assert_eq!(large.len(), 16);
        assert_eq!(large[..4], [(0, 5), (333, 5), (666, 5), (999, 5)]);
        assert_eq!(large[12..], [(0, 76), (333, 76), (666, 76), (999, 76)]);
        assert_eq!(of(2..3, 0..1, 1), [(2, 0)]);
        assert_eq!(of(0..u32::MAX, 0..1, 2), [(0, 0), (u32::MAX - 1, 0)]);
    }
}
