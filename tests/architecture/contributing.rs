//! The page for contributors names the files that a control method consists of, and no other file knows one.

use std::fs;
use std::path::{Path, PathBuf};

use super::{files, root};

/// The page, from the repository's root.
const PAGE: &str = ".github/CONTRIBUTING.md";

/// The list of methods.
const LIST: &str = "src/control/methods/mod.rs";

/// What in src/ may name methods beside their own folder: the paper's figures, each of which shows one.
const PAPER: &str = "src/reproduce";

/// The files between backquotes in what a page says of adding a control method, up to the end of the first sentence.
fn touched(page: &str) -> Vec<String> {
    let after = page.split("**a control method**").nth(1).unwrap_or_default();
    let sentence = after.split(". ").next().unwrap_or_default();
    sentence.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The methods of the list, by the names of their variants.
fn methods(list: &str) -> Vec<String> {
    let listed = list.split("\nmethods! {").nth(1).unwrap_or_default();
    let listed = listed.split("\n}").next().unwrap_or_default();
    let variant = |line: &str| line.trim().split_once('(').map(|(name, _)| name.to_owned());
    listed.lines().filter(|line| !line.trim().starts_with('/')).filter_map(variant).collect()
}

/// The words by which files may know a method, from the name of its variant.
fn names(method: &str) -> Vec<String> {
    let own = method.to_lowercase();
    let of_shader = ["act", "is_at_rest", "passed"].map(|what| format!("{own}_{what}"));
    let mut names =
        vec![method.to_owned(), format!("{method}Setting"), format!("METHOD_{}", own.to_uppercase())];
    names.push(format!("\"{own}\""));
    names.extend(of_shader);
    names
}

/// The lines of files that know a method without belonging to it.
fn knowing(sources: &[(PathBuf, String)], method: &str) -> Vec<String> {
    let own = format!("{}.", method.to_lowercase());
    let belongs = |file: &Path| {
        let is_own = file.file_name().is_some_and(|name| name.to_string_lossy().starts_with(&own));
        is_own || file.starts_with("src/control/methods") || file.starts_with(PAPER)
    };
    let word = |c: char| c.is_alphanumeric() || c == '_' || c == '"';
    let names = names(method);
    let knows = |line: &&str| {
        let code = line.split("//").next().unwrap_or_default();
        code.split(|c| !word(c)).any(|word| names.iter().any(|name| name == word))
    };
    let others = sources.iter().filter(|(file, _)| !belongs(file));
    others
        .flat_map(|(file, text)| {
            text.lines().filter(knows).map(move |line| format!("{}: {}", file.display(), line.trim()))
        })
        .collect()
}

/// Every file of src/ and shaders/, by its path from the repository's root.
fn sources() -> Vec<(PathBuf, String)> {
    let of = |folder: &str| {
        files(folder).into_iter().map(move |(file, text)| (Path::new(folder).join(file), text)).collect()
    };
    ["src", "shaders"].into_iter().flat_map::<Vec<_>, _>(of).collect()
}

#[test]
fn a_control_method_consists_of_the_files_that_the_page_names() {
    let page = fs::read_to_string(root().join(PAGE)).unwrap();
    let touched = touched(&page);
    assert_eq!(touched, ["src/control/methods/NAME.rs", "shaders/control/methods/NAME.wgsl", LIST]);
    let methods = methods(&fs::read_to_string(root().join(LIST)).unwrap());
    assert_eq!(methods, ["Sine", "Pulse", "Delay", "Ogy"]);
    let sources = sources();
    assert!(sources.len() > 300, "{} files are found", sources.len());
    for method in methods {
        for file in &touched {
            let file = file.replace("NAME", &method.to_lowercase());
            assert!(root().join(&file).is_file(), "there is no {file}");
        }
        let none: [&str; 0] = [];
        assert_eq!(knowing(&sources, &method), none, "{method} is known elsewhere");
    }
}

#[test]
fn files_that_know_a_method_are_found() {
    let known = |file: &str, line: &str| knowing(&[(file.into(), line.to_owned())], "Pulse").len();
    assert_eq!(known("src/cli/control.rs", "Scheme::Pulse(pulse) => draw(pulse),"), 1);
    assert_eq!(known("src/render/control.rs", "use crate::control::methods::PulseSetting;"), 1);
    assert_eq!(known("src/cli/control.rs", "if method == \"pulse\" {"), 1);
    assert_eq!(known("shaders/control/action.wgsl", "return pulse_act(seen);"), 1);
    assert_eq!(known("shaders/control/methods/pulse.wgsl", "fn pulse_act(seen: Seen) -> Action {"), 0);
    assert_eq!(known("src/control/methods/mod.rs", "    Pulse(PulseSetting),"), 0);
    assert_eq!(known("src/dynamics/point.rs", "x, // Pulse"), 0);
    assert_eq!(known("src/dynamics/point.rs", "let impulse = pulses;"), 0);
    assert_eq!(methods("macro\nmethods! {\n    /// One(x).\n    One(OneSetting),\n}\nTwo(x)\n"), ["One"]);
    assert_eq!(touched("**a control method**: `a` and\n`b`. Then `c`."), ["a", "b"]);
}
