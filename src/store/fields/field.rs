//! What a file holds, field by field.

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
}

/// What a file holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileContent {
    /// What the file is called in the documentation.
    pub title: &'static str,
    /// The command and the option that write it.
    pub written_by: &'static str,
    /// Its arrays or columns, in order.
    pub fields: Vec<Field>,
}

impl FileContent {
    /// The names of the fields, in order.
    pub fn names(&self) -> Vec<&'static str> {
        self.fields.iter().map(|field| field.name).collect()
    }
}
