//! Every result file, written by the program, against the tables of their documentation.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::Path;

use impact_atlas::store::fields::{FileContent, files};
use npyz::{DType, NpyFile};
use tempfile::tempdir;
use zip::ZipArchive;

use crate::run::{run_in, stderr};

/// An array of an archive: its type as NumPy writes it, and its shape.
type Arrays = BTreeMap<String, (String, Vec<u64>)>;

fn arrays(path: &Path) -> Arrays {
    let mut zip = ZipArchive::new(File::open(path).unwrap()).unwrap();
    let names: Vec<String> = zip.file_names().map(|name| name.unwrap().into_owned()).collect();
    names
        .into_iter()
        .map(|file| {
            let array = NpyFile::new(zip.by_name(&file).unwrap()).unwrap();
            let DType::Plain(kind) = array.dtype() else { panic!("{file} is no plain array") };
            (file.trim_end_matches(".npy").to_owned(), (kind.to_string(), array.shape().to_vec()))
        })
        .collect()
}

/// What does not fit between an archive and the table; sizes with a name are whatever they are, but always the same.
fn misfits(found: &Arrays, content: &FileContent) -> Vec<String> {
    let mut sizes: BTreeMap<&str, u64> = BTreeMap::new();
    let mut wrong = Vec::new();
    for field in &content.fields {
        let Some((kind, shape)) = found.get(field.name) else {
            wrong.push(format!("{} is not there", field.name));
            continue;
        };
        let expected = match field.kind {
            "u8" => "|u1",
            "u16" => "<u2",
            "u32" => "<u4",
            "f32" => "<f4",
            "f64" => "<f8",
            _ => "<U",
        };
        if !kind.trim_matches('\'').starts_with(expected) {
            wrong.push(format!("{} is {kind} and not {}", field.name, field.kind));
        }
        let names: Vec<&str> = field.shape.split(", ").filter(|name| !name.is_empty()).collect();
        let fits = names.len() == shape.len()
            && names.iter().zip(shape).all(|(name, &size)| match name.parse::<u64>() {
                Ok(number) => size == number,
                Err(_) => *sizes.entry(name).or_insert(size) == size,
            });
        if !fits {
            wrong.push(format!("{} has shape {shape:?} and not {}", field.name, field.shape));
        }
    }
    let known = content.names();
    wrong.extend(found.keys().filter(|name| !known.contains(&name.as_str())).cloned());
    wrong
}

fn content(title: &str) -> FileContent {
    files().into_iter().find(|file| file.title.starts_with(title)).unwrap()
}

/// Small runs that write every file there is, with the beginning of its title.
const RUNS: [(&str, &str, &str); 5] = [
    (
        "A map,",
        "map --certify --extents --backend cpu --x omega=2.8:3.8:4 --y delta=0.1:0.3:3 --transient 20 --observe 10",
        "map.npz",
    ),
    (
        "A map under",
        "map --control delay --backend cpu --x omega=2.8:2.9:4 --y gain=0:1:3 --from 20 --iterates 60",
        "map.npz",
    ),
    ("A run", "control delay --set omega=2.83 --from 20 --iterates 60 --data c.npz", "c.npz"),
    (
        "A bifurcation",
        "bifurcation --x omega=4:3.1:5 --sweep both --spectrum --transient 20 --observe 16",
        "bifurcation.npz",
    ),
    (
        "Bifurcation curves",
        "curves --backend cpu --x r=0.6:0.9:8 --y zeta=0.05:0.25:6 --set omega=2.4 --set delta=0.2 --out c.csv",
        "c.csv",
    ),
];

fn written(folder: &Path, command: &str) {
    let output = run_in(folder, &command.split_whitespace().collect::<Vec<_>>());
    assert_eq!(output.status.code(), Some(0), "{command}: {}", stderr(&output));
}

#[test]
fn every_file_has_the_fields_of_the_table() {
    for (title, command, file) in RUNS {
        let folder = tempdir().unwrap();
        written(folder.path(), command);
        let path = folder.path().join(file);
        if file.ends_with(".npz") {
            assert_eq!(misfits(&arrays(&path), &content(title)), [""; 0], "{title}");
        } else {
            assert_eq!(first_line(&path), content(title).names().join(","), "{title}");
        }
    }
    let folder = tempdir().unwrap();
    written(folder.path(), "orbit --transient 20 --periods 1 --impacts i.csv --trajectory t.csv");
    for (file, title) in [("i.csv", "The impacts"), ("t.csv", "The trajectory")] {
        assert_eq!(first_line(&folder.path().join(file)), content(title).names().join(","));
    }
}

fn first_line(path: &Path) -> String {
    fs::read_to_string(path).unwrap().lines().next().unwrap().to_owned()
}

#[test]
fn other_fields_would_be_noticed() {
    let folder = tempdir().unwrap();
    let (title, command, file) = RUNS[0];
    written(folder.path(), command);
    let found = arrays(&folder.path().join(file));
    let content = content(title);
    let missing = misfits(&found, &self::content("A map under"));
    let missing = missing.iter().filter(|wrong| wrong.ends_with("is not there")).count();
    assert_eq!(missing, 7, "what control adds is not there");
    let plain = tempdir().unwrap();
    written(plain.path(), &command.replace("--certify ", ""));
    assert_eq!(misfits(&arrays(&plain.path().join(file)), &content), ["multipliers is not there"]);
    let mut other = found.clone();
    other.remove("lyapunov");
    assert!(misfits(&other, &content)[0].contains("lyapunov"));
    let mut other = found.clone();
    other.get_mut("p").unwrap().0 = "<u4".to_owned();
    assert!(misfits(&other, &content)[0].contains("p is"));
    let mut other = found.clone();
    other.get_mut("state").unwrap().1 = vec![4, 3, 4];
    assert!(misfits(&other, &content)[0].contains("state has shape"));
    let mut other = found;
    other.insert("more".to_owned(), ("<f8".to_owned(), vec![1]));
    assert_eq!(misfits(&other, &content), ["more"]);
}

/// The ragged readings are as many as the counts say, and infinitely many impacts are the number of the table.
#[test]
fn readings_and_sentinels_are_those_of_the_table() {
    let folder = tempdir().unwrap();
    written(
        folder.path(),
        "bifurcation --backend cpu --x omega=0.25:0.26:2 --set delta=0.545 --transient 40 --observe 16",
    );
    let mut zip = ZipArchive::new(File::open(folder.path().join("bifurcation.npz")).unwrap()).unwrap();
    let readings = NpyFile::new(zip.by_name("readings.npy").unwrap()).unwrap().into_vec::<f64>().unwrap();
    let counts = NpyFile::new(zip.by_name("counts.npy").unwrap()).unwrap().into_vec::<u32>().unwrap();
    assert_eq!(counts.iter().sum::<u32>() as usize, readings.len());
    let impacts = NpyFile::new(zip.by_name("p.npy").unwrap()).unwrap().into_vec::<u16>().unwrap();
    assert!(impacts.contains(&65535), "{impacts:?}");
    assert!(content("A bifurcation").fields.iter().any(|field| field.meaning.contains("65535")));

    let never =
        "map --control delay --backend cpu --x omega=2.83:2.83:1 --y gain=0:0:1 --from 20 --iterates 60";
    written(folder.path(), never);
    let mut zip = ZipArchive::new(File::open(folder.path().join("map.npz")).unwrap()).unwrap();
    let array = NpyFile::new(zip.by_name("converged_at.npy").unwrap()).unwrap();
    assert_eq!(array.into_vec::<u32>().unwrap(), [4_294_967_295]);
    assert!(content("A map under").fields.iter().any(|field| field.meaning.contains("4294967295")));
}
