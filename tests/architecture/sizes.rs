//! Files are small: one concept each.

use std::path::PathBuf;

use super::sources;

/// The most lines that a file of src/ or shaders/ has.
const MOST_LINES: usize = 300;

/// The languages that it counts for, by the ends of their files' names.
const LANGUAGES: [&str; 5] = ["rs", "wgsl", "js", "css", "html"];

/// The files that have more.
fn too_long(files: &[(PathBuf, String)]) -> Vec<String> {
    let lengths = files.iter().map(|(file, text)| (file, text.lines().count()));
    let long = lengths.filter(|(_, lines)| *lines > MOST_LINES);
    long.map(|(file, lines)| format!("{} has {lines} lines", file.display())).collect()
}

#[test]
fn no_file_is_long() {
    for folder in ["src", "shaders"] {
        let files = sources(folder, &LANGUAGES);
        assert!(files.len() > 10, "the files of {folder} are found");
        let wrong = too_long(&files);
        assert!(wrong.is_empty(), "a file has {MOST_LINES} lines at most: {wrong:#?}");
    }
}

#[test]
fn long_files_are_found() {
    let of = |lines: usize| [(PathBuf::from("a.rs"), "fn f() {}\n".repeat(lines))];
    assert!(too_long(&of(MOST_LINES)).is_empty());
    assert_eq!(too_long(&of(MOST_LINES + 1)).len(), 1);
}
