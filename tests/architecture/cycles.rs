//! The files of src/ use each other one way only.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::PathBuf;

use super::files;
use super::modules::Modules;

type Uses = BTreeMap<PathBuf, BTreeMap<PathBuf, String>>;

/// The way back from a file to itself, the shortest: each file with the path by which it uses the next.
fn way_back(uses: &Uses, from: &PathBuf) -> Option<Vec<(PathBuf, String)>> {
    let mut came: BTreeMap<&PathBuf, &PathBuf> = BTreeMap::new();
    let mut queue = VecDeque::from([from]);
    while let Some(file) = queue.pop_front() {
        for next in uses.get(file).into_iter().flat_map(|next| next.keys()) {
            if next == from {
                let mut way = vec![(file.clone(), uses[file][next].clone())];
                let mut at = file;
                while at != from {
                    let before = came[at];
                    way.push((before.clone(), uses[before][at].clone()));
                    at = before;
                }
                way.reverse();
                return Some(way);
            }
            if !came.contains_key(next) {
                came.insert(next, file);
                queue.push_back(next);
            }
        }
    }
    None
}

/// The cycles between files, each once: the shortest through each file.
fn cycles(sources: &[(PathBuf, String)]) -> Vec<String> {
    let uses = Modules::of(sources).uses();
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    for file in uses.keys() {
        let Some(way) = way_back(&uses, file) else { continue };
        let members: BTreeSet<PathBuf> = way.iter().map(|(file, _)| file.clone()).collect();
        if seen.insert(members) {
            let steps: Vec<String> =
                way.iter().map(|(file, path)| format!("{} names {path}", file.display())).collect();
            found.push(steps.join("; "));
        }
    }
    found
}

#[test]
fn files_use_each_other_one_way() {
    let sources = files("src");
    let uses = Modules::of(&sources).uses();
    assert!(uses.values().map(BTreeMap::len).sum::<usize>() > 1000, "the uses of files are found");
    let wrong = cycles(&sources);
    assert!(wrong.is_empty(), "{wrong:#?}");
}

fn found(sources: &[(&str, &str)]) -> usize {
    let sources: Vec<(PathBuf, String)> =
        sources.iter().map(|&(file, source)| (PathBuf::from(file), source.to_owned())).collect();
    cycles(&sources).len()
}

#[test]
fn cycles_between_files_are_found() {
    let parent = ("a/mod.rs", "mod b; mod c; pub use b::B; pub use c::C;");
    assert_eq!(found(&[parent, ("a/b.rs", "use super::c::C;"), ("a/c.rs", "use super::b::B;")]), 1);
    // Through what the parent hands on, by another name, and without an import.
    let parent_renames = ("a/mod.rs", "mod b; mod c; pub use b::B as D; pub use c::C;");
    assert_eq!(found(&[parent_renames, ("a/b.rs", "use super::C;"), ("a/c.rs", "use crate::a::D;")]), 1);
    assert_eq!(
        found(&[parent, ("a/b.rs", "fn f(c: super::C) {}"), ("a/c.rs", "fn g() { crate::a::b::h() }")]),
        1
    );
    assert_eq!(
        found(&[parent, ("a/b.rs", "use super::c; fn f() { c::g() }"), ("a/c.rs", "use super::B;")]),
        1
    );
    // A child uses what its parent defines, and the parent the child.
    let defines = "struct P; fn f() -> b::B { b::g() }";
    assert_eq!(found(&[("a/mod.rs", &format!("mod b; {defines}")), ("a/b.rs", "use super::P;")]), 1);
    let imports = "mod b; pub use b::B; struct P(B);";
    assert_eq!(found(&[("a/mod.rs", imports), ("a/b.rs", "use super::P;")]), 1);
    // Three files, and the blocks of files.
    let rest = [("y.rs", "use crate::z::Z;"), ("z.rs", "mod inner { use crate::x::X; }")];
    assert_eq!(found(&[("x.rs", "use crate::y::Y;"), rest[0], rest[1]]), 1);
}

#[test]
fn other_uses_are_no_cycles() {
    let parent = ("a/mod.rs", "mod b; mod c; pub use b::B; pub(crate) use c::C;");
    assert_eq!(found(&[parent, ("a/b.rs", "use super::C;"), ("a/c.rs", "")]), 0);
    let defines = ("a/mod.rs", "mod b; pub use b::B; pub struct P;");
    assert_eq!(found(&[defines, ("a/b.rs", "use super::P;")]), 0);
    let tests = "#[cfg(test)] mod tests { use crate::a::B; }";
    assert_eq!(found(&[parent, ("a/b.rs", "use super::C;"), ("a/c.rs", tests)]), 0);
    let apart = [("a/mod.rs", "mod b; #[cfg(test)] mod t; struct P;"), ("a/t.rs", "use super::b;")];
    assert_eq!(found(&[apart[0], apart[1], ("a/b.rs", "use super::t::f;")]), 0);
    assert_eq!(
        found(&[parent, ("a/b.rs", "use super::C; /// [`B`](super::B)\nfn f() {}"), ("a/c.rs", "")]),
        0
    );
}
