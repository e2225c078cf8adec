//! Connected sets of cells.

/// A cell: column and row.
pub type Cell = (u32, u32);

/// The connected sets of cells with equal keys, in the order of their first cells; cells without a key belong to none.
///
/// Cells that meet at a corner are connected, so that a thin oblique band does not fall apart. `keys` has one key per cell,
/// row by row.
///
/// # Panics
/// If there are not as many keys as cells.
pub fn connected<K: PartialEq>(keys: &[Option<K>], columns: u32, rows: u32) -> Vec<Vec<Cell>> {
    assert_eq!(keys.len() as u64, u64::from(columns) * u64::from(rows), "one key per cell");
    let index = |(column, row): Cell| row as usize * columns as usize + column as usize;
    let mut taken = vec![false; keys.len()];
    let mut found = Vec::new();
    for first in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))) {
        let own = &keys[index(first)];
        if own.is_none() || taken[index(first)] {
            continue;
        }
        let mut cells = Vec::new();
        let mut open = vec![first];
        taken[index(first)] = true;
        while let Some(cell) = open.pop() {
            cells.push(cell);
            for beside in around(cell, columns, rows) {
                if !taken[index(beside)] && keys[index(beside)] == *own {
                    taken[index(beside)] = true;
                    open.push(beside);
                }
            }
        }
        found.push(cells);
    }
    found
}

/// A cell and the up to eight cells that it touches.
fn around((column, row): Cell, columns: u32, rows: u32) -> impl Iterator<Item = Cell> {
    let beside = |i: u32, count: u32| i.saturating_sub(1)..(i + 2).min(count);
    beside(row, rows).flat_map(move |row| beside(column, columns).map(move |column| (column, row)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_connect_and_gaps_part() {
        // The a's meet at corners; one of the b's is apart.
        let keys: Vec<Option<char>> =
            "ab..b.a..b.a..b".chars().map(|key| (key != '.').then_some(key)).collect();
        let sizes: Vec<(char, usize)> = connected(&keys, 5, 3)
            .into_iter()
            .map(|cells| (keys[(cells[0].1 * 5 + cells[0].0) as usize].unwrap(), cells.len()))
            .collect();
        assert_eq!(sizes, [('a', 3), ('b', 1), ('b', 3)]);
        let apart = connected(&[Some(1), None, Some(1)], 3, 1);
        assert_eq!(apart, [[(0, 0)], [(2, 0)]]);
    }
}
