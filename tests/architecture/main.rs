//! The architecture, held to: rooms and files use each other one way only, wgpu stays in its folder, shaders have their twins and no policy of their own, files are small, and the page that shows a way through them leads somewhere.

mod contributing;
mod cycles;
mod literals;
mod modules;
mod sizes;
mod way;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// The rooms of src/, lowest first; a room may use those of the rows above its own.
const ORDER: [&[&str]; 18] = [
    &["figure"],
    &["system"],
    &["model"],
    &["dynamics"],
    &["analysis"],
    &["theory"],
    &["control"],
    &["plane"],
    &["curves"],
    &["paper"],
    &["diagram"],
    &["backend"],
    &["store", "render"],
    &["sweep"],
    &["validate"],
    &["reproduce"],
    &["explore"],
    &["cli"],
];

/// Uses that are forbidden although the order allows them: files and pictures know results, not what computed them.
const FORBIDDEN: [(&str, &str); 2] = [("store", "backend"), ("render", "backend")];

/// The only folder that names wgpu.
const GPU: [&str; 2] = ["backend", "gpu"];

/// Folders of shaders/ without a twin in src/.
const WITHOUT_TWIN: [&str; 2] = ["shared", "kernels"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Every file below a folder of the repository whose name ends in one of some ways, with its path from that folder, in order.
fn sources(folder: &str, ends: &[&str]) -> Vec<(PathBuf, String)> {
    fn collect(folder: &Path, base: &Path, ends: &[&str], files: &mut Vec<(PathBuf, String)>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                collect(&path, base, ends, files);
            } else if path.extension().is_some_and(|extension| ends.iter().any(|end| extension == *end)) {
                files.push((path.strip_prefix(base).unwrap().to_owned(), fs::read_to_string(&path).unwrap()));
            }
        }
    }
    let base = root().join(folder);
    let mut found = Vec::new();
    collect(&base, &base, ends, &mut found);
    found.sort();
    found
}

/// Every file of Rust or WGSL below a folder of the repository.
fn files(folder: &str) -> Vec<(PathBuf, String)> {
    sources(folder, &["rs", "wgsl"])
}

/// The module that a file of src/ holds; the crate's root is the empty path.
fn module(file: &Path) -> Vec<String> {
    let mut segments: Vec<String> =
        file.with_extension("").iter().map(|part| part.to_str().unwrap().to_owned()).collect();
    if matches!(segments.last().map(String::as_str), Some("mod" | "lib" | "main")) {
        segments.pop();
    }
    segments
}

fn tokens(source: &str) -> Vec<TokenTree> {
    source.parse::<TokenStream>().expect("the sources are Rust").into_iter().collect()
}

fn ident(token: Option<&TokenTree>) -> Option<String> {
    match token {
        Some(TokenTree::Ident(ident)) => Some(ident.to_string()),
        _ => None,
    }
}

fn is_punct(token: Option<&TokenTree>, expected: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == expected)
}

fn group(token: Option<&TokenTree>) -> Option<Vec<TokenTree>> {
    match token {
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace => {
            Some(group.stream().into_iter().collect())
        }
        _ => None,
    }
}

/// Adds the paths from the crate's root that begin with `at`, the token after `prefix` and its `::`.
fn follow(prefix: &[String], at: &[TokenTree], paths: &mut BTreeSet<Vec<String>>) {
    if let Some(branches) = group(at.first()) {
        for branch in branches.split(|token| is_punct(Some(token), ',')) {
            follow(prefix, branch, paths);
        }
        return;
    }
    let mut path = prefix.to_vec();
    match ident(at.first()).as_deref() {
        Some("super") => drop(path.pop()),
        Some("self") => {}
        Some(name) => path.push(name.to_owned()),
        None => return,
    }
    if is_punct(at.get(1), ':') && is_punct(at.get(2), ':') {
        follow(&path, &at[3..], paths);
    } else {
        paths.insert(path);
    }
}

/// Every path from this crate's root that code in `module` names: by `crate::`, `impact_atlas::` or `super::`.
fn paths(module: &[String], code: &[TokenTree], found: &mut BTreeSet<Vec<String>>) {
    for (i, token) in code.iter().enumerate() {
        let within = i >= 2 && is_punct(code.get(i - 1), ':') && is_punct(code.get(i - 2), ':');
        let path = is_punct(code.get(i + 1), ':') && is_punct(code.get(i + 2), ':');
        match (token, ident(Some(token)).as_deref()) {
            (_, Some("crate" | "impact_atlas")) if path => follow(&[], &code[i + 3..], found),
            (_, Some("super")) if path && !within => follow(module, &code[i..], found),
            (TokenTree::Group(inner), _) => {
                let inner: Vec<TokenTree> = inner.stream().into_iter().collect();
                let mut module = module.to_vec();
                if i >= 2 && ident(code.get(i - 2)).as_deref() == Some("mod") {
                    module.extend(ident(code.get(i - 1)));
                }
                paths(&module, &inner, found);
            }
            _ => {}
        }
    }
}

fn rank(room: &str) -> Option<usize> {
    ORDER.iter().position(|row| row.contains(&room))
}

/// What is wrong with one file's use of other rooms.
fn upward_edges(file: &Path, source: &str) -> Vec<String> {
    let module = module(file);
    let Some(room) = module.first() else { return Vec::new() };
    let Some(own) = rank(room) else { return vec![format!("{}: no such room", file.display())] };
    let mut named = BTreeSet::new();
    paths(&module, &tokens(source), &mut named);
    named
        .iter()
        .filter(|path| path.first().is_some_and(|target| target != room))
        .filter(|path| {
            let target = path[0].as_str();
            let below = rank(target).is_some_and(|rank| rank < own);
            !below || FORBIDDEN.contains(&(room, target))
        })
        .map(|path| format!("{}: {room} names {}", file.display(), path.join("::")))
        .collect()
}

fn names_wgpu(code: &[TokenTree]) -> bool {
    code.iter().any(|token| match token {
        TokenTree::Ident(ident) => ident == "wgpu",
        TokenTree::Group(inner) => names_wgpu(&inner.stream().into_iter().collect::<Vec<_>>()),
        _ => false,
    })
}

/// What is wrong with one file's use of wgpu.
fn strays_from_gpu(file: &Path, source: &str) -> Option<String> {
    let stray = names_wgpu(&tokens(source)) && !module(file).starts_with(&GPU.map(str::to_owned));
    stray.then(|| format!("{} names wgpu", file.display()))
}

/// What is wrong with a shader fragment, given the files of src/ and the source that assembles the shaders.
fn misplaced(shader: &Path, text: &str, rust: &BTreeSet<PathBuf>, assembly: &str) -> Vec<String> {
    let folder = shader.iter().next().unwrap().to_str().unwrap();
    let mut wrong = Vec::new();
    if !WITHOUT_TWIN.contains(&folder) && !rust.contains(&shader.with_extension("rs")) {
        wrong.push(format!("{} has no twin in src/", shader.display()));
    }
    if !assembly.contains(&format!("shaders/{}\")", shader.display())) {
        wrong.push(format!("{} is in no shader", shader.display()));
    }
    if (folder == "kernels") != text.contains("@compute") {
        wrong.push(format!("{}: entry points are in kernels/, and nowhere else", shader.display()));
    }
    wrong
}

#[test]
fn rooms_use_each_other_one_way() {
    let wrong: Vec<String> =
        files("src").iter().flat_map(|(file, source)| upward_edges(file, source)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn upward_edges_are_found() {
    let found = |file: &str, source: &str| upward_edges(Path::new(file), source).len();
    assert_eq!(found("model/system.rs", "use crate::dynamics::Point;"), 1);
    assert_eq!(found("analysis/mod.rs", "fn f() { crate::plane::Start::Rest; }"), 1);
    assert_eq!(found("dynamics/point.rs", "use crate::{model::Flight, sweep::{self, sweep}};"), 2);
    assert_eq!(found("plane/axis.rs", "mod tests { use super::super::super::{cli, model}; }"), 1);
    assert_eq!(found("plane.rs", "use super::backend as b;"), 1);
    assert_eq!(found("store/npz/mod.rs", "use crate::backend::Cpu;"), 1);
    assert_eq!(found("render/mod.rs", "const X: u8 = vec![crate::store::Y][0];"), 1);
    assert_eq!(found("sweep.rs", "use impact_atlas::validate;"), 1);
    assert_eq!(found("attic/mod.rs", ""), 1);
    assert_eq!(found("model/mod.rs", "use crate::Everything;"), 1);
}

#[test]
fn downward_edges_are_allowed() {
    let found = |file: &str, source: &str| upward_edges(Path::new(file), source);
    let none: Vec<String> = Vec::new();
    assert_eq!(found("sweep.rs", "use crate::{plane::Plane, backend::*}; mod tests { use super::*; }"), none);
    assert_eq!(found("cli/map.rs", "use super::CliError; use impact_atlas::sweep::sweep;"), none);
    assert_eq!(
        found("model/a.rs", "/// See crate::dynamics::Point.\nfn f(s: &str) { g(\"crate::cli\") }"),
        none
    );
    assert_eq!(found("main.rs", "mod cli; use crate::cli::run;"), none);
    assert_eq!(found("model/a.rs", "pub(crate) mod b { use super::super::generator; }"), none);
}

#[test]
fn only_the_gpu_folder_names_wgpu() {
    let wrong: Vec<String> =
        files("src").iter().filter_map(|(file, source)| strays_from_gpu(file, source)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(files("src").iter().any(|(_, source)| names_wgpu(&tokens(source))));
    assert!(strays_from_gpu(Path::new("backend/mod.rs"), "fn f(a: wgpu::Adapter) {}").is_some());
    assert!(strays_from_gpu(Path::new("backend/gpu/a.rs"), "fn f(a: wgpu::Adapter) {}").is_none());
}

#[test]
fn every_shader_is_assembled_and_has_its_twin() {
    let rust: BTreeSet<PathBuf> = files("src").into_iter().map(|(file, _)| file).collect();
    let assembly: String = (files("src").into_iter())
        .filter(|(file, _)| ["backend/gpu/shader", "control/methods"].iter().any(|own| file.starts_with(own)))
        .map(|(_, source)| source)
        .collect();
    let shaders = files("shaders");
    assert!(shaders.len() > 10);
    let wrong: Vec<String> =
        shaders.iter().flat_map(|(file, text)| misplaced(file, text, &rust, &assembly)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let orphan = misplaced(Path::new("dynamics/orphan.wgsl"), "@compute fn f() {}", &rust, &assembly);
    assert_eq!(orphan.len(), 3, "{orphan:?}");
}
