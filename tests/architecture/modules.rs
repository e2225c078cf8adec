//! The modules of the crate and what a path in them names, as far as `use` and `mod` tell it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use proc_macro2::TokenTree;

use super::{group, ident, is_punct, module, tokens};

/// A path of names from the crate's root.
type Name = Vec<String>;

/// One module: a file, or a block within one.
struct Module {
    file: PathBuf,
    /// What its `use` items bind: the name here, and the path that it stands for.
    bound: BTreeMap<String, Name>,
    /// The paths that it names: all those of its code, and those that it imports for itself.
    named: BTreeSet<Name>,
}

/// All modules of some sources, without those that only tests have.
pub struct Modules(BTreeMap<Name, Module>);

/// An item of the program, as a path leads to it.
enum Found {
    Module(Name),
    Item(PathBuf),
}

/// The modules of some files, each with its file and its code, without what only tests have.
pub fn of_the_program(sources: &[(PathBuf, String)]) -> Vec<(Name, &Path, Vec<TokenTree>)> {
    let mut of_tests = BTreeSet::new();
    let parsed: Vec<(Name, &Path, Vec<TokenTree>)> = sources
        .iter()
        .map(|(file, source)| (module(file), file.as_path(), tokens(source)))
        .map(|(name, file, code)| {
            let code = without_tests(&name, code, &mut of_tests);
            (name, file, code)
        })
        .collect();
    let of_tests = |name: &Name| (1..=name.len()).any(|length| of_tests.contains(&name[..length]));
    // The library's root and the program's declare the rooms and define nothing that these use.
    parsed.into_iter().filter(|(name, ..)| !name.is_empty() && !of_tests(name)).collect()
}

impl Modules {
    /// The modules of some files, each with its source.
    pub fn of(sources: &[(PathBuf, String)]) -> Self {
        let mut modules = Modules(BTreeMap::new());
        let kept = of_the_program(sources);
        // Every module is known before a path is read, as a path may begin with a child's name.
        for (name, file, code) in &kept {
            modules.declare(name, file, code);
        }
        for (name, _, code) in &kept {
            modules.read(name, code);
        }
        modules
    }

    fn declare(&mut self, name: &[String], file: &Path, code: &[TokenTree]) {
        let entry = Module { file: file.to_owned(), bound: BTreeMap::new(), named: BTreeSet::new() };
        self.0.insert(name.to_vec(), entry);
        for (child, inner) in blocks(name, code) {
            self.declare(&child, file, &inner);
        }
    }

    /// Reads the `use` items and then the paths of a module and of its blocks.
    fn read(&mut self, name: &[String], code: &[TokenTree]) {
        let mut imports = Vec::new();
        let rest = self.imports(name, code, &mut imports);
        for import in &imports {
            let module = self.0.get_mut(name).expect("it is declared");
            module.bound.insert(import.here.clone(), import.path.clone());
        }
        let mut named = BTreeSet::new();
        // What is handed on is a use only where the module's own code names it.
        named.extend(imports.into_iter().filter(|import| !import.public).map(|import| import.path));
        self.mentions(name, &rest, &mut named);
        self.0.get_mut(name).expect("it is declared").named.extend(named);
        for (child, inner) in blocks(name, code) {
            self.read(&child, &inner);
        }
    }

    /// Takes the `use` items and the blocks of modules out of some code.
    fn imports(&self, name: &[String], code: &[TokenTree], imports: &mut Vec<Import>) -> Vec<TokenTree> {
        let mut rest = Vec::new();
        let mut i = 0;
        while i < code.len() {
            match ident(code.get(i)).as_deref() {
                Some("use") => {
                    let length = code[i..].iter().take_while(|token| !is_punct(Some(token), ';')).count();
                    let public = is_public(&code[..i]);
                    let tree = &code[i + 1..(i + length).min(code.len())];
                    let mut found = Vec::new();
                    import_tree(&[], tree, &mut found);
                    imports.extend(found.into_iter().filter_map(|(here, path)| {
                        Some(Import { here, path: self.absolute(name, &path, &BTreeMap::new())?, public })
                    }));
                    i += length + 1;
                }
                Some("mod") if ident(code.get(i + 1)).is_some() => i += 3,
                _ => {
                    rest.push(code[i].clone());
                    i += 1;
                }
            }
        }
        rest
    }

    /// Adds the paths that code names, `use` within functions included.
    fn mentions(&self, name: &[String], code: &[TokenTree], named: &mut BTreeSet<Name>) {
        let bound = &self.0[name].bound;
        let mut i = 0;
        while i < code.len() {
            if let TokenTree::Group(inner) = &code[i] {
                let inner: Vec<TokenTree> = inner.stream().into_iter().collect();
                let mut imports = Vec::new();
                let rest = self.imports(name, &inner, &mut imports);
                named.extend(imports.into_iter().map(|import| import.path));
                self.mentions(name, &rest, named);
            }
            let Some(first) = ident(code.get(i)) else {
                i += 1;
                continue;
            };
            let mut path = vec![first];
            let member =
                i > 0 && is_punct(code.get(i - 1), '.') && !(i > 1 && is_punct(code.get(i - 2), '.'));
            let defined = i > 0 && ident(code.get(i - 1)).as_deref() == Some("fn");
            i += 1;
            while is_punct(code.get(i), ':')
                && is_punct(code.get(i + 1), ':')
                && ident(code.get(i + 2)).is_some()
            {
                path.extend(ident(code.get(i + 2)));
                i += 3;
            }
            let word =
                path[0].chars().all(|letter| letter.is_lowercase() || letter == '_' || letter.is_numeric());
            let call = matches!(code.get(i), Some(TokenTree::Group(_))) || is_punct(code.get(i), ':');
            if member || defined || (path.len() == 1 && word && !call) {
                continue;
            }
            if path.len() > 1 || bound.contains_key(&path[0]) {
                named.extend(self.absolute(name, &path, bound));
            }
        }
    }

    /// A path in a module from the crate's root; none where it leads out of the crate.
    fn absolute(&self, name: &[String], path: &[String], bound: &BTreeMap<String, Name>) -> Option<Name> {
        let mut at = name.to_vec();
        let mut rest = path;
        match path[0].as_str() {
            "crate" | "impact_atlas" => {
                at.clear();
                rest = &path[1..];
            }
            "self" => rest = &path[1..],
            "super" => {
                while rest.first().is_some_and(|part| part == "super") {
                    at.pop();
                    rest = &rest[1..];
                }
            }
            first => match bound.get(first) {
                Some(to) => {
                    at.clone_from(to);
                    rest = &path[1..];
                }
                None => {
                    let child: Name = name.iter().chain([&path[0]]).cloned().collect();
                    self.0.get(&child)?;
                }
            },
        }
        at.extend(rest.iter().cloned());
        Some(at)
    }

    /// Where the path from the crate's root leads; none where it leads to nothing in a file.
    fn find(&self, path: &[String], depth: usize) -> Option<Found> {
        let mut at: Name = Vec::new();
        for (i, part) in path.iter().enumerate() {
            let last = i + 1 == path.len();
            let child: Name = at.iter().chain([part]).cloned().collect();
            let to = self.0.get(&at).and_then(|module| module.bound.get(part));
            match to {
                Some(to) if (last || !self.0.contains_key(&child)) && depth < 16 && to[..] != path[..=i] => {
                    return match self.find(to, depth + 1)? {
                        Found::Module(found) => {
                            let rest: Name = found.into_iter().chain(path[i + 1..].iter().cloned()).collect();
                            self.find(&rest, depth + 1)
                        }
                        item => Some(item),
                    };
                }
                _ if self.0.contains_key(&child) => at = child,
                _ => return self.0.get(&at).map(|module| Found::Item(module.file.clone())),
            }
        }
        Some(Found::Module(at))
    }

    /// Which files each file uses, with one path that shows it.
    pub fn uses(&self) -> BTreeMap<PathBuf, BTreeMap<PathBuf, String>> {
        let mut uses: BTreeMap<PathBuf, BTreeMap<PathBuf, String>> = BTreeMap::new();
        for module in self.0.values() {
            let of = uses.entry(module.file.clone()).or_default();
            for path in &module.named {
                if let Some(Found::Item(file)) = self.find(path, 0)
                    && file != module.file
                {
                    of.insert(file, path.join("::"));
                }
            }
        }
        uses
    }
}

/// What one branch of a `use` item binds.
struct Import {
    here: String,
    path: Name,
    public: bool,
}

/// Whether the item behind these tokens is public, to whatever extent.
fn is_public(before: &[TokenTree]) -> bool {
    let before = match before.last() {
        Some(TokenTree::Group(_)) => &before[..before.len() - 1],
        _ => before,
    };
    ident(before.last()).as_deref() == Some("pub")
}

/// Adds what the tree of a `use` item binds: the name, and the path as it is written.
fn import_tree(prefix: &[String], tree: &[TokenTree], found: &mut Vec<(String, Name)>) {
    if let Some(branches) = group(tree.first()) {
        for branch in branches.split(|token| is_punct(Some(token), ',')) {
            import_tree(prefix, branch, found);
        }
        return;
    }
    let Some(part) = ident(tree.first()) else { return };
    let mut path = prefix.to_vec();
    if part != "self" || prefix.is_empty() {
        path.push(part);
    }
    if is_punct(tree.get(1), ':') && is_punct(tree.get(2), ':') {
        import_tree(&path, &tree[3..], found);
        return;
    }
    let renamed = (ident(tree.get(1)).as_deref() == Some("as")).then(|| ident(tree.get(2))).flatten();
    let here = renamed.unwrap_or_else(|| path.last().expect("a path has a name").clone());
    found.push((here, path));
}

/// The blocks of modules in some code: their paths and what is in them.
fn blocks(name: &[String], code: &[TokenTree]) -> Vec<(Name, Vec<TokenTree>)> {
    let mut found = Vec::new();
    for i in 0..code.len() {
        if ident(code.get(i)).as_deref() == Some("mod")
            && let (Some(child), Some(inner)) = (ident(code.get(i + 1)), group(code.get(i + 2)))
        {
            found.push((name.iter().cloned().chain([child]).collect(), inner));
        }
    }
    found
}

/// Some code without what is marked `#[cfg(test)]`; the modules of that mark are noted.
fn without_tests(name: &[String], code: Vec<TokenTree>, of_tests: &mut BTreeSet<Name>) -> Vec<TokenTree> {
    let mut kept = Vec::new();
    let mut i = 0;
    while i < code.len() {
        let marked = is_punct(code.get(i), '#')
            && matches!(code.get(i + 1), Some(TokenTree::Group(mark)) if mark.to_string().replace(' ', "") == "[cfg(test)]");
        if !marked {
            kept.push(code[i].clone());
            i += 1;
            continue;
        }
        i += 2;
        while !is_punct(code.get(i), ';') && group(code.get(i)).is_none() && i < code.len() {
            if ident(code.get(i)).as_deref() == Some("mod") {
                of_tests.insert(name.iter().cloned().chain(ident(code.get(i + 1))).collect());
            }
            i += 1;
        }
        i += 1;
    }
    kept
}
