//! The page that follows one parameter through the program names files and items that are there.

use std::fs;

use super::root;

/// The page, from the repository's root.
const PAGE: &str = "src/parameter.md";

/// The most files on the way.
const MOST_STEPS: usize = 8;

/// One step: a file, and the items in it.
#[derive(Debug, PartialEq)]
struct Step {
    file: String,
    items: Vec<String>,
}

/// The text between pairs of backquotes.
fn quoted(text: &str) -> Vec<String> {
    text.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The steps of a page: "1. `file` (`item`, `item`): …".
fn steps(page: &str) -> Vec<Step> {
    let numbered = page.lines().filter(|line| line.starts_with(|first: char| first.is_ascii_digit()));
    let read = |line: &str| {
        let head = line.split("): ").next().unwrap_or_default();
        let mut names = quoted(head).into_iter();
        Step { file: names.next().unwrap_or_default(), items: names.collect() }
    };
    numbered.map(read).collect()
}

/// Whether the text of a file defines an item: by a keyword before its name, as a member of a struct, or as a key of a table.
fn defines(text: &str, item: &str) -> bool {
    text.lines().map(str::trim).filter(|line| !line.starts_with(['/', '#'])).any(|line| {
        let words: Vec<&str> = line.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
        let keywords = ["fn", "struct", "enum", "trait", "const", "type"];
        let declared = words.windows(2).any(|pair| keywords.contains(&pair[0]) && pair[1] == item);
        let line = line.strip_prefix("pub ").unwrap_or(line);
        let member =
            line.strip_prefix(item).is_some_and(|rest| rest.starts_with(": ") && rest.ends_with(','));
        let key = line.strip_prefix(item).is_some_and(|rest| rest.starts_with(" = "));
        declared || member || key
    })
}

/// What is wrong with a page.
fn wrong(page: &str) -> Vec<String> {
    let steps = steps(page);
    let mut wrong = Vec::new();
    if steps.is_empty() || steps.len() > MOST_STEPS {
        wrong.push(format!("{} steps", steps.len()));
    }
    for Step { file, items } in steps {
        let Ok(text) = fs::read_to_string(root().join(&file)) else {
            wrong.push(format!("there is no file {file}"));
            continue;
        };
        if items.is_empty() {
            wrong.push(format!("nothing is named in {file}"));
        }
        let missing = items.iter().filter(|item| !defines(&text, item));
        wrong.extend(missing.map(|item| format!("{file} defines no {item}")));
    }
    wrong
}

#[test]
fn the_way_of_a_parameter_leads_through_files_and_items_that_exist() {
    let page = fs::read_to_string(root().join(PAGE)).unwrap();
    let none: Vec<String> = Vec::new();
    assert_eq!(wrong(&page), none);
    let steps = steps(&page);
    assert!(steps.first().unwrap().file.starts_with("src/cli/"), "it begins at the command line");
    assert!(steps.iter().any(|step| step.file.ends_with(".wgsl")), "it passes a shader");
    assert!(steps.last().unwrap().file.starts_with("src/plane/"), "and ends in a cell of a map");
    let crate_page = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    assert!(crate_page.contains("include_str!(\"parameter.md\")"), "the crate's documentation has the page");
}

#[test]
fn a_way_that_leads_nowhere_is_found() {
    let step = |file: &str, items: &str| wrong(&format!("Words.\n\n1. `{file}` ({items}): and `more`.\n"));
    assert_eq!(step("src/system/setting.rs", "`Setting`, `with`").len(), 0);
    assert_eq!(step("src/system/setting.rs", "`Setting`, `without`").len(), 1);
    // A name that is only used or spoken of is not defined there.
    assert_eq!(step("src/system/setting.rs", "`Family`").len(), 1);
    assert_eq!(step("src/system/nowhere.rs", "`Setting`").len(), 1);
    assert_eq!(step("src/system/setting.rs", "").len(), 1);
    assert_eq!(wrong("No step at all.\n"), ["0 steps"]);
    let long: String = (1..=9).map(|k| format!("{k}. `src/system/setting.rs` (`Setting`): x.\n")).collect();
    assert_eq!(wrong(&long), ["9 steps"]);
    assert!(!defines("let gap = 0.5; // restitution: f32,", "restitution"));
    assert!(defines("    pub restitution: [T; 2],", "restitution"));
    assert!(defines("r = { default = 0.8 }", "r") && !defines("rate = 1", "r"));
}
