//! Connected sets of cells.

/// A cell: column and row.
pub type Cell = (u32, u32);

/// Which cells touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Adjacency {
    /// Those with a side in common.
    Sides,
    /// Those that meet at a corner too, so that a thin oblique band does not fall apart.
    Corners,
}

/// The connected sets of cells with equal keys, in the order of their first cells; cells without a key belong to none.
///
/// `keys` has one key per cell, row by row.
///
/// # Panics
/// If there are not as many keys as cells.
pub fn connected<K: PartialEq>(
    keys: &[Option<K>],
    columns: u32,
    rows: u32,
    adjacency: Adjacency,
) -> Vec<Vec<Cell>> {
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
            for next in beside(cell, columns, rows, adjacency) {
                if !taken[index(next)] && keys[index(next)] == *own {
                    taken[index(next)] = true;
                    open.push(next);
                }
            }
        }
        found.push(cells);
    }
    found
}

/// The up to four, or eight, cells that a cell touches.
pub fn beside(cell: Cell, columns: u32, rows: u32, adjacency: Adjacency) -> impl Iterator<Item = Cell> {
    let near = |i: u32, count: u32| i.saturating_sub(1)..(i + 2).min(count);
    let around =
        near(cell.1, rows).flat_map(move |row| near(cell.0, columns).map(move |column| (column, row)));
    around.filter(move |&other| {
        let sides = u32::from(other.0 != cell.0) + u32::from(other.1 != cell.1);
        sides == 1 || (sides == 2 && adjacency == Adjacency::Corners)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_connect_and_gaps_part() {
        // The a's meet at corners; one of the b's is apart.
        let keys: Vec<Option<char>> =
            "ab..b.a..b.a..b".chars().map(|key| (key != '.').then_some(key)).collect();
        let sizes: Vec<(char, usize)> = connected(&keys, 5, 3, Adjacency::Corners)
            .into_iter()
            .map(|cells| (keys[(cells[0].1 * 5 + cells[0].0) as usize].unwrap(), cells.len()))
            .collect();
        assert_eq!(sizes, [('a', 3), ('b', 1), ('b', 3)]);
        let apart = connected(&[Some(1), None, Some(1)], 3, 1, Adjacency::Corners);
        assert_eq!(apart, [[(0, 0)], [(2, 0)]]);
        let oblique = [Some(1), None, None, Some(1)];
        assert_eq!(connected(&oblique, 2, 2, Adjacency::Corners).len(), 1);
        assert_eq!(connected(&oblique, 2, 2, Adjacency::Sides).len(), 2);
    }
}
