//! The documentation of result files, made of their table.

use std::fmt::Write;

use super::field::Field;
use super::table::files;

/// The documentation of every file, as Markdown.
pub fn documentation() -> String {
    let mut text = String::from(INTRODUCTION);
    for file in files() {
        write!(text, "\n## {}\n\n{}\n\n", file.title, file.written_by).expect("a string takes everything");
        text.push_str("| field | type | shape | unit | meaning |\n|---|---|---|---|---|\n");
        for field in &file.fields {
            let Field { name, kind, shape, unit, meaning } = field;
            writeln!(text, "| `{name}` | {kind} | {shape} | {unit} | {meaning} |")
                .expect("a string takes everything");
        }
    }
    text
}

const INTRODUCTION: &str = "\
# Result files

Archives are NumPy's (`numpy.load` reads them, without pickles); tables are CSV with a line of names. Everything is
non-dimensional (of the paper's oscillator lengths in static deflections (P1+P2)/K1, times in √(M1/K1), velocities in
lengths over times; of others as their file says), unit 1 below. In planes rows run along y, and the first row is the first y value. The same configuration gives the same bytes.
A state is (x1 … xn, v1 … vn) at forcing phase 0, (x1, x2, v1, v2) of the paper's oscillator: the size `component` is 2n,
`coordinate` n, and `stop` the number of stops. A point on σ, the section of a stop, is the velocity just after an impact there of the coordinate
with the largest share of the stop's direction, the other displacements, the other velocities, and the forcing phase: 2n
numbers, (v1+, x2, v2, τ) at x1 = +δ. `config` holds the whole text of
the system's file, and its hash, under `system`.
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_documentation_is_made_of_the_table() {
        let written = include_str!("../files.md");
        assert!(written == documentation(), "src/store/files.md should be:\n{}", documentation());
    }

    #[test]
    fn no_field_comes_twice_and_all_say_what_they_are() {
        for file in files() {
            let mut names = file.names();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), file.fields.len(), "{}", file.title);
            assert!(file.fields.iter().all(|field| field.meaning.len() > 10), "{}", file.title);
        }
    }
}
