//! Planes in stores: killed and resumed, in parts, at once, refused; and the pictures drawn from them.

mod interrupted;
mod memory;
mod parts;
mod pictures;
mod refused;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// A plane of 30 tiles that takes a second or two.
const PLANE: &str =
    "map --backend cpu --x omega=0.4:3.9:48 --y delta=0.05:0.5:40 --transient 60 --observe 40 --tile 8";

/// A plane that takes a moment.
const SMALL: &str = "map --backend cpu --x omega=2.6:3.9:12 --y delta=0.05:0.3:9 --transient 40 --observe 40";

/// Every file of a store that readers see, with its bytes.
fn files(store: &Path) -> BTreeMap<String, Vec<u8>> {
    fn collect(folder: &Path, base: &Path, found: &mut BTreeMap<String, Vec<u8>>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                if path.file_name().unwrap() != ".impact-atlas" {
                    collect(&path, base, found);
                }
            } else {
                let name = path.strip_prefix(base).unwrap().display().to_string();
                found.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    let mut found = BTreeMap::new();
    collect(store, store, &mut found);
    found
}

/// How often each tile was noted as done.
fn times_done(store: &Path) -> BTreeMap<u64, u32> {
    let mut times = BTreeMap::new();
    for entry in fs::read_dir(store.join(".impact-atlas")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "log") {
            for line in fs::read_to_string(path).unwrap().lines() {
                let event: serde_json::Value = serde_json::from_str(line).unwrap();
                if event["event"] == "done" {
                    *times.entry(event["tile"].as_u64().unwrap()).or_default() += 1;
                }
            }
        }
    }
    times
}
