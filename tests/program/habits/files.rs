//! Files that are there, names, links, and standard output.

use std::fs;

use tempfile::tempdir;

use crate::habits::SMALL;
use crate::run::{done, names, refuses, run_in, stderr, stdout, words};

#[test]
fn files_that_are_there_stay() {
    let commands = [
        (SMALL, &["map.png", "map.npz"][..]),
        (
            "orbit --transient 10 --periods 1 --impacts i.csv --trajectory t.csv --out o.svg",
            &["i.csv", "t.csv", "o.svg"],
        ),
        (
            "control delay --set omega=2.83 --from 20 --iterates 60 --data c.npz --out c.png",
            &["c.npz", "c.png"],
        ),
        (
            "bifurcation --x omega=4:3.9:3 --backend cpu --transient 10 --observe 5",
            &["bifurcation.png", "bifurcation.npz"],
        ),
        ("curves --backend cpu --x omega=20:21:4 --y delta=5:6:4 --transient 9 --out c.csv", &["c.csv"]),
        (
            "map --control delay --backend cpu --x omega=2.8:2.9:3 --y gain=0:1:3 --from 9 --iterates 30 --times t.png",
            &["map.png", "map.npz", "t.png"],
        ),
    ];
    for (command, files) in commands {
        for file in files {
            let folder = tempdir().unwrap();
            fs::write(folder.path().join(file), "theirs").unwrap();
            let refused = run_in(folder.path(), &words(command));
            assert_eq!(refused.status.code(), Some(2), "{command}: {}", stderr(&refused));
            assert!(
                stderr(&refused).contains(file) && stderr(&refused).contains("--force"),
                "{}",
                stderr(&refused)
            );
            assert_eq!(names(folder.path()), [*file], "{command}");
            assert_eq!(fs::read_to_string(folder.path().join(file)).unwrap(), "theirs");
        }
        let folder = tempdir().unwrap();
        for file in files {
            fs::write(folder.path().join(file), "theirs").unwrap();
        }
        let output = done(folder.path(), &format!("{command} --force"));
        let mut wanted: Vec<&str> = files.to_vec();
        wanted.sort_unstable();
        assert_eq!(names(folder.path()), wanted);
        for file in files {
            assert_ne!(fs::read(folder.path().join(file)).unwrap(), b"theirs", "{file}");
            assert!(stderr(&output).contains(file), "{file} is not listed: {}", stderr(&output));
        }
    }
}

#[test]
fn a_reproduction_brings_its_own_files_up_to_date_and_no_others() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("report.md"), "theirs").unwrap();
    let command = "reproduce --figure 10 --out .";
    let refused = run_in(folder.path(), &words(command));
    assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
    assert!(stderr(&refused).contains("report.md") && stderr(&refused).contains("--force"));
    assert_eq!(names(folder.path()), ["report.md"]);
    let forced = done(folder.path(), &format!("{command} --force"));
    for file in ["fig10.json", "fig10.png", "report.json", "report.md"] {
        assert!(stderr(&forced).contains(file), "{}", stderr(&forced));
    }
    done(folder.path(), command);
    fs::write(folder.path().join("fig10.json"), "theirs").unwrap();
    let refused = run_in(folder.path(), &words(command));
    assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
    assert_eq!(fs::read_to_string(folder.path().join("fig10.json")).unwrap(), "theirs");
    refuses(&["reproduce", "--out", "-"], &["standard output"]);
}

#[test]
fn names_fit_what_files_hold() {
    refuses(&words("map --out map.jpg"), &["map.jpg", ".png, .svg or .pdf"]);
    refuses(&words("map --data map.png --out other.png"), &["map.png", ".npz"]);
    refuses(&words("map --control delay --times t.csv"), &["t.csv", ".svg"]);
    refuses(&words("orbit --impacts i.png"), &["i.png", ".csv"]);
    refuses(&words("orbit --trajectory t.npz"), &["t.npz", ".csv"]);
    refuses(&words("orbit --out o.csv"), &["o.csv", ".svg"]);
    refuses(&words("control delay --data c.json"), &["c.json", ".npz"]);
    refuses(&words("bifurcation --x omega=4:3:5 --data d.csv"), &["d.csv", ".npz"]);
    refuses(&words("curves --out c.txt"), &["c.txt", ".csv"]);
}

#[test]
fn a_dash_is_standard_output() {
    let folder = tempdir().unwrap();
    let picture = done(folder.path(), &format!("{SMALL} --out -"));
    assert!(picture.stdout.starts_with(b"\x89PNG"));
    assert!(stderr(&picture).contains("24 cells"), "{}", stderr(&picture));
    assert!(stderr(&picture).contains("written: standard output"), "{}", stderr(&picture));
    assert_eq!(names(folder.path()), [""; 0]);
    let data = done(folder.path(), &format!("{SMALL} --out m.svg --data - --quiet"));
    assert!(data.stdout.starts_with(b"PK") && data.stderr.is_empty(), "{}", stderr(&data));
    assert_eq!(names(folder.path()), ["m.svg"]);
    let table = done(folder.path(), "orbit --transient 10 --periods 1 --impacts -");
    assert!(
        stdout(&table).starts_with("time,stop,") && !stdout(&table).contains("largest"),
        "{}",
        stdout(&table)
    );
    let both = done(folder.path(), &format!("{SMALL} --out - --json"));
    assert!(both.stdout.starts_with(b"\x89PNG") && stderr(&both).contains("\"cells\": 24"));
    refuses(&words("orbit --impacts - --trajectory -"), &["two results"]);
    refuses(&words("map --out - --data -"), &["two results"]);
}

#[cfg(unix)]
#[test]
fn links_are_followed() {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("far")).unwrap();
    std::os::unix::fs::symlink("far/made.csv", folder.path().join("i.csv")).unwrap();
    done(folder.path(), "orbit --transient 10 --periods 1 --impacts i.csv");
    assert!(folder.path().join("i.csv").is_symlink());
    assert!(fs::read_to_string(folder.path().join("far/made.csv")).unwrap().starts_with("time,"));
    let again = run_in(folder.path(), &words("orbit --transient 10 --periods 1 --impacts i.csv"));
    assert_eq!(again.status.code(), Some(2), "{}", stderr(&again));
}
