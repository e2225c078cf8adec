//! What result files hold, field by field: the tables of `files.md`, to which the files that commands write are held.

/// An array of an archive, or a column of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// The name in the file.
    pub name: &'static str,
    /// u8, u16, u32, f32, f64 or text; in tables what stands there.
    pub kind: &'static str,
    /// The sizes by name, the outermost first; empty for a single text, and in tables.
    pub shape: &'static str,
    /// The unit; empty for what has none.
    pub unit: &'static str,
    /// What it is, and what its special values mean.
    pub meaning: &'static str,
}

impl Field {
    /// Whether NaN or infinity may stand there; its meaning says when.
    pub fn may_be_missing(&self) -> bool {
        self.meaning.contains("NaN") || self.meaning.contains("infinity")
    }

    /// A row of a table.
    fn of(row: &'static str) -> Option<Self> {
        let cells: Vec<&str> = row.strip_prefix('|')?.strip_suffix('|')?.split('|').map(str::trim).collect();
        let [name, kind, shape, unit, meaning] = cells[..] else { return None };
        Some(Field { name: name.trim_matches('`'), kind, shape, unit, meaning })
    }
}

/// What a file holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileContent {
    /// What the file is called in the documentation.
    pub title: &'static str,
    /// Its arrays or columns, in order.
    pub fields: Vec<Field>,
}

impl FileContent {
    /// The names of the fields, in order.
    pub fn names(&self) -> Vec<&'static str> {
        self.fields.iter().map(|field| field.name).collect()
    }

    /// A section of the documentation, its heading without the marks before it.
    fn of(section: &'static str) -> Self {
        let (title, text) = section.split_once('\n').unwrap_or((section, ""));
        // The first two rows are the heads of the columns and the rule below them.
        FileContent { title, fields: text.lines().filter_map(Field::of).skip(2).collect() }
    }
}

/// Every file that holds results.
pub fn files() -> Vec<FileContent> {
    include_str!("files.md").split("\n## ").skip(1).map(FileContent::of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::regime_codes;
    use crate::plane::fields::{CELL_FIELDS, CellField, Inner};

    /// The row of a field of cells, as the table of maps must have it.
    fn row(cell: &CellField) -> Field {
        let shape = match cell.inner {
            Inner::One => "y, x",
            Inner::Stops => "y, x, stop",
            Inner::Components => "y, x, component",
            Inner::Coordinates => "y, x, coordinate",
            Inner::Multipliers => "y, x, component, 2",
        };
        let CellField { name, unit, meaning, .. } = *cell;
        Field { name, kind: cell.kind().name(), shape, unit, meaning }
    }

    #[test]
    fn the_table_of_maps_has_the_fields_of_cells() {
        let [map, controlled, ..] = &files()[..] else { panic!("there are no tables") };
        let cells: Vec<Field> = CELL_FIELDS.iter().map(row).collect();
        assert_eq!(map.fields[..cells.len()], cells);
        assert_eq!(map.names()[cells.len()..], ["x", "y", "config"]);
        let shared = controlled.fields.iter().filter(|field| field.name != "state");
        let shared: Vec<&Field> = shared.filter(|field| CellField::named(field.name).is_some()).collect();
        assert_eq!(shared.len(), 10);
        assert!(shared.into_iter().all(|field| cells.contains(field)));
    }

    #[test]
    fn every_table_is_read_whole_and_all_say_what_they_are() {
        let files = files();
        let rows = include_str!("files.md").lines().filter(|line| line.starts_with("| `")).count();
        assert_eq!(files.iter().map(|file| file.fields.len()).sum::<usize>(), rows);
        assert_eq!(files.len(), 7);
        for file in files {
            let mut names = file.names();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), file.fields.len(), "{}", file.title);
            assert!(file.fields.iter().all(|field| field.meaning.len() > 10), "{}", file.title);
            let regime = file.fields.iter().find(|field| field.name == "regime");
            assert!(
                regime.is_none_or(|regime| regime.meaning.starts_with(regime_codes!())),
                "{}",
                file.title
            );
        }
    }
}
