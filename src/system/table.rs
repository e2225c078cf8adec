//! A table of a TOML file, its entries, and the place of everything that is read.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{FamilyError, Place};

/// A family's file.
pub(super) struct Source<'a> {
    pub file: &'a str,
    pub text: &'a str,
}

impl Source<'_> {
    /// The place of the character `at` bytes into the file.
    pub fn place(&self, at: usize, key: &str) -> Place {
        let before = self.text.as_bytes().iter().take(at);
        let line = 1 + before.filter(|&&byte| byte == b'\n').count();
        Place { file: self.file.to_owned(), line, key: key.to_owned() }
    }

    /// The whole file as a table.
    ///
    /// # Errors
    /// That it is not TOML, with the line.
    pub fn parse(&self) -> Result<Spanned<DeTable<'_>>, FamilyError> {
        DeTable::parse(self.text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            let message = error.message().lines().collect::<Vec<_>>().join(", ");
            let problem = format!(
                "this is not TOML: {message}; `impact-atlas systems shaw-holmes` prints a file to begin with"
            );
            FamilyError { place: self.place(at, ""), problem }
        })
    }
}

/// A value with its place.
#[derive(Clone)]
pub(super) struct Item<'a> {
    source: &'a Source<'a>,
    key: String,
    at: usize,
    value: &'a DeValue<'a>,
}

impl<'a> Item<'a> {
    pub fn place(&self) -> Place {
        self.source.place(self.at, &self.key)
    }

    pub fn error(&self, problem: impl Into<String>) -> FamilyError {
        FamilyError { place: self.place(), problem: problem.into() }
    }

    /// More than this version can follow.
    pub fn too_many(&self, count: usize, what: &str, most: usize) -> FamilyError {
        self.error(format!("{count} {what}: this version follows 1 to {most}"))
    }

    /// A name that cannot be one.
    pub fn cannot_name(&self, what: &str, name: &str, reason: &str) -> FamilyError {
        self.error(format!("`{name}` cannot name {what}, {reason}: choose another name"))
    }

    fn wrong_kind(&self, wanted: &'static str) -> FamilyError {
        let found = match self.value {
            DeValue::String(_) => "a text",
            DeValue::Integer(_) | DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "true or false",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a section",
        };
        self.error(format!("this is {found}: write {wanted}"))
    }

    /// A text in quotes that is more than blanks.
    pub fn text(&self, wanted: &'static str) -> Result<&'a str, FamilyError> {
        let text = self.value.as_str().ok_or_else(|| self.wrong_kind(wanted))?;
        if text.trim().is_empty() { Err(self.error(format!("empty: write {wanted}"))) } else { Ok(text) }
    }

    /// A number that stands there as such.
    pub fn bare_number(&self) -> Option<Result<f64, FamilyError>> {
        let (digits, radix) = match self.value {
            DeValue::Integer(integer) => (integer.as_str(), integer.radix()),
            DeValue::Float(float) => (float.as_str(), 10),
            _ => return None,
        };
        let value = match radix {
            10 => digits.parse().ok(),
            _ => i64::from_str_radix(digits, radix).ok().map(|whole| whole as f64),
        };
        let finite = value.filter(|value: &f64| value.is_finite());
        Some(finite.ok_or_else(|| self.error(format!("{digits} is not a finite number: write one"))))
    }

    /// A finite number.
    pub fn number(&self) -> Result<f64, FamilyError> {
        self.bare_number().unwrap_or_else(|| Err(self.wrong_kind("a number")))
    }

    /// The entries of a list, which are counted from 1 in their keys.
    pub fn list(&self, wanted: &'static str) -> Result<Vec<Item<'a>>, FamilyError> {
        let array = self.value.as_array().ok_or_else(|| self.wrong_kind(wanted))?;
        let entry = |(i, value): (usize, &'a Spanned<DeValue<'a>>)| Item {
            source: self.source,
            key: format!("{}[{}]", self.key, i + 1),
            at: value.span().start,
            value: value.get_ref(),
        };
        if array.is_empty() {
            return Err(self.error(format!("empty: write {wanted}")));
        }
        Ok(array.iter().enumerate().map(entry).collect())
    }

    /// Whether this is a table: a section of the file, or braces.
    pub fn is_table(&self) -> bool {
        self.value.is_table()
    }

    /// The table that this is.
    pub fn table(&self, wanted: &'static str) -> Result<Table<'a>, FamilyError> {
        let table = self.value.as_table().ok_or_else(|| self.wrong_kind(wanted))?;
        Ok(Table { source: self.source, key: self.key.clone(), at: self.at, table })
    }
}

/// A table with its place.
pub(super) struct Table<'a> {
    source: &'a Source<'a>,
    key: String,
    at: usize,
    table: &'a DeTable<'a>,
}

impl<'a> Table<'a> {
    pub fn root(source: &'a Source<'a>, table: &'a DeTable<'a>) -> Self {
        Table { source, key: String::new(), at: 0, table }
    }

    fn key(&self, name: &str) -> String {
        if self.key.is_empty() { name.to_owned() } else { format!("{}.{name}", self.key) }
    }

    /// Every key with its value, in the order of the file.
    pub fn items(&self) -> Vec<(&'a str, Item<'a>)> {
        let item = |(name, value): (&'a Spanned<_>, &'a Spanned<DeValue<'a>>)| {
            let name_text: &'a std::borrow::Cow<'a, str> = name.get_ref();
            let at = name.span().start;
            (&**name_text, Item { source: self.source, key: self.key(name_text), at, value: value.get_ref() })
        };
        let mut items: Vec<_> = self.table.iter().map(item).collect();
        items.sort_by_key(|(_, item)| item.at);
        items
    }

    pub fn optional(&self, name: &str) -> Option<Item<'a>> {
        self.items().into_iter().find(|(key, _)| *key == name).map(|(_, item)| item)
    }

    /// # Errors
    /// That it is missing, at the section's own line, with an example to write.
    pub fn required(&self, name: &str, example: &'static str) -> Result<Item<'a>, FamilyError> {
        self.optional(name).ok_or_else(|| FamilyError {
            place: self.source.place(self.at, &self.key(name)),
            problem: format!("missing: write {example}"),
        })
    }

    /// # Errors
    /// The first key that is none of these.
    pub fn only(&self, known: &[&str]) -> Result<(), FamilyError> {
        match self.items().into_iter().find(|(key, _)| !known.contains(key)) {
            Some((_, item)) => {
                let known = known.join(", ");
                Err(item.error(format!("unknown key: remove it, or write one of {known}")))
            }
            None => Ok(()),
        }
    }
}
