//! The commands that draw, from outside: orbits, bifurcation diagrams, the paper's figures.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::tempdir;

use crate::run::{names, program, refuses, run_in, stderr, stdout};

fn done(folder: &Path, arguments: &[&str]) -> Output {
    let output = run_in(folder, arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    output
}

/// The configuration in a PNG's text chunk.
fn config_of_png(path: &Path) -> Value {
    let reader =
        png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap())).read_info().unwrap();
    let chunk = reader.info().utf8_text.iter().find(|chunk| chunk.keyword == "impact-atlas").unwrap();
    serde_json::from_str(&chunk.get_text().unwrap()).unwrap()
}

#[test]
fn orbits_are_drawn_as_pixels_and_as_vectors() {
    let folder = tempdir().unwrap();
    let at =
        ["orbit", "--set", "omega=3.7", "--transient", "300", "--periods", "2", "--section-periods", "50"];
    let panels = ["--panel", "portrait", "--panel", "time", "--panel", "section:x2,v2", "--panel", "strobe"];
    done(folder.path(), &[&at[..], &panels, &["--out", "o.png", "--size", "1400x1100"]].concat());
    done(folder.path(), &[&at[..], &panels, &["--out", "o.svg", "--impacts", "i.csv"]].concat());
    assert_eq!(names(folder.path()), ["i.csv", "o.png", "o.svg"]);
    let svg = fs::read_to_string(folder.path().join("o.svg")).unwrap();
    for words in
        ["(a) phase portrait", "(b) time series", "impact Poincaré section", "strobe section", "stops "]
    {
        assert!(svg.contains(words), "{words}");
    }
    let config = config_of_png(&folder.path().join("o.png"));
    assert_eq!(config["panels"][2], "section:x2,v2");
    // The command that the picture carries makes the same picture.
    let command: Vec<&str> = config["command"].as_str().unwrap().split_whitespace().skip(1).collect();
    done(folder.path(), &[&command[..], &["--out", "again.png", "--size", "1400x1100"]].concat());
    let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
    // The command beside them names another file.
    let pixels = |name: &str| image::load_from_memory(&bytes(name)).unwrap().into_rgb8();
    assert!(pixels("o.png") == pixels("again.png"));
    done(
        folder.path(),
        &[&command[..], &["--zoom", "t=0.5:1", "--out", "z.png", "--size", "1400x1100"]].concat(),
    );
    assert!(bytes("o.png") != bytes("z.png"));
}

#[test]
fn plots_that_cannot_be_are_refused() {
    let orbit = |more: &[&'static str]| [&["orbit", "--out", "o.png"], more].concat();
    refuses(&orbit(&["--panel", "phase"]), &["`phase`", "portrait, portrait2, time"]);
    refuses(&orbit(&["--panel", "strobe:tau,x2"]), &["tau", "strobe section"]);
    refuses(&orbit(&["--zoom", "t=2:1"]), &["t=2:1", "empty"]);
    refuses(&orbit(&["--zoom", "tau=1:2"]), &["--zoom tau=1:2", "no panel"]);
    refuses(&orbit(&["--zoom", "t=1:2", "--zoom", "t=1:3"]), &["t=1:2", "t=1:3", "two ranges"]);
    refuses(&orbit(&["--size", "100x80", "--transient", "1"]), &["100 × 80", "at least"]);
    refuses(&["orbit", "--out", "o.jpg"], &["o.jpg", ".png, .svg or .pdf"]);
    refuses(&["orbit", "--out", "o.svg", "--impacts", "o.svg"], &["two results"]);
    refuses(&["orbit", "--panel", "time"], &["--out"]);
    let periods = ["--section-periods", "50"];
    refuses(&orbit(&periods), &["--section-periods 50", "no effect", "add a --panel"]);
    refuses(&[&["orbit"], &periods[..]].concat(), &["--section-periods 50", "no effect"]);
}

/// To and fro between two stops, at once and without loss: more impacts in a period than can be followed.
#[test]
fn a_hopeless_orbit_is_given_up() {
    let folder = tempdir().unwrap();
    let hopeless = ["orbit", "--set", "r=1", "--set", "zeta=0", "--set", "delta=1e-6", "--set", "omega=0.05"];
    let fast = ["--start", "0,0,1,0", "--transient", "4", "--impacts", "i.csv", "--out", "o.png"];
    let output = run_in(folder.path(), &[&hopeless[..], &fast].concat());
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("given up in forcing period"), "{}", stderr(&output));
    assert_eq!(names(folder.path()), [""; 0]);
}

const COLUMNS: [&str; 7] = ["bifurcation", "--x", "omega=3.9:3.1:9", "--transient", "200", "--observe", "20"];

#[test]
fn a_diagram_is_drawn_stored_and_summed_up() {
    let folder = tempdir().unwrap();
    let more = ["--backend", "cpu", "--spectrum", "--out", "d.svg", "--json"];
    let output = done(folder.path(), &[&COLUMNS[..], &more].concat());
    assert_eq!(names(folder.path()), ["d.npz", "d.svg"]);
    let summary: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!((&summary["columns"], &summary["points"]), (&9.into(), &180.into()));
    assert_eq!((&summary["backend"], &summary["coexistence"]), (&"cpu".into(), &Value::Null));
    let svg = fs::read_to_string(folder.path().join("d.svg")).unwrap();
    for words in ["forcing frequency ", "velocity before impact ", "1-1-1 symmetric", "λ"] {
        assert!(svg.contains(words), "{words}");
    }
    // The axis runs as written: the first value is at the left.
    let place = |label: &str| {
        let text = svg.lines().find(|line| line.contains(&format!("aria-label=\"{label}\""))).unwrap();
        let matrix = text.split("matrix(").nth(1).unwrap().split(')').next().unwrap();
        matrix.split(' ').nth(4).unwrap().parse::<f64>().unwrap()
    };
    assert!(place("3.8") < place("3.2"));
}

#[test]
fn carried_sweeps_state_where_motions_coexist() {
    let folder = tempdir().unwrap();
    let both = ["bifurcation", "--x", "omega=4.1:2.7:15", "--set", "delta=0.6", "--sweep", "both"];
    let more = ["--start", "symmetric", "--transient", "300", "--observe", "20"];
    let output = done(folder.path(), &[&both[..], &more].concat());
    let text = stdout(&output);
    assert!(text.contains("coexistence for omega from 2.7"), "{text}");
    assert!(text.contains("no impact (down) and 1-1-1 symmetric (up)"), "{text}");
    assert!(stderr(&output).contains("a carried sweep is a sequence"), "{}", stderr(&output));
    assert_eq!(names(folder.path()), ["bifurcation.npz", "bifurcation.png"]);
    assert_eq!(config_of_png(&folder.path().join("bifurcation.png"))["sweep"], "both");
}

#[test]
fn diagrams_that_cannot_be_are_refused() {
    let diagram = |more: &[&'static str]| [&COLUMNS[..], more].concat();
    refuses(&["bifurcation"], &["--x"]);
    refuses(&["bifurcation", "--x", "omgea=5:1:9"], &["omgea", "omega, delta"]);
    refuses(&["bifurcation", "--x", "omega=1:1:9"], &["empty"]);
    refuses(&["bifurcation", "--x", "r=1.5:0.5:9"], &["r = 1.5", "between 0 and 1"]);
    refuses(&diagram(&["--set", "omega=3"]), &["--set omega=3", "--x omega=3.9:3.1:9"]);
    refuses(&diagram(&["--sweep", "sideways"]), &["sideways", "rest, symmetric"]);
    refuses(&diagram(&["--start", "rest"]), &["--start rest", "no effect"]);
    refuses(&diagram(&["--sweep", "down", "--backend", "gpu"]), &["--backend gpu", "sequence"]);
    refuses(&diagram(&["--section", "C"]), &["`C`", "strobe"]);
    refuses(&diagram(&["--section", "strobe", "--record", "tau"]), &["tau", "strobe section"]);
    refuses(&diagram(&["--record", "v3"]), &["`v3`", "v_before"]);
    refuses(
        &["bifurcation", "--x", "omega=3.9:3.1:9", "--observe", "0"],
        &["observation of 0 forcing periods"],
    );
    refuses(&diagram(&["--points", "0"]), &["0 points", "--points 1"]);
    refuses(&diagram(&["--out", "d.png", "--data", "d.png"]), &["two results"]);
    refuses(&diagram(&["--out", "d.gif"]), &["d.gif", ".svg"]);
    refuses(&["bifurcation", "--x", "v1=-1:1:9", "--sweep", "up"], &["--sweep up", "--sweep rest"]);
    refuses(&diagram(&["--size", "200x100"]), &["200 × 100", "at least"]);
}

#[test]
fn a_map_may_be_vectors() {
    let folder = tempdir().unwrap();
    let small =
        ["map", "--backend", "cpu", "--x", "omega=2.8:3.8:6", "--y", "delta=0.1:0.3:4", "--out", "m.svg"];
    done(folder.path(), &[&small[..], &["--transient", "50", "--observe", "50"]].concat());
    assert_eq!(names(folder.path()), ["m.npz", "m.svg"]);
    let svg = fs::read_to_string(folder.path().join("m.svg")).unwrap();
    assert!(svg.contains("half clearance") && svg.contains("<metadata id=\"impact-atlas\">"));
    assert!(!svg.contains("<text") && svg.contains("<use "), "text does not depend on installed fonts");
}

const TINY: [&str; 9] =
    ["map", "--backend", "cpu", "--transient", "50", "--observe", "50", "--data", "m.npz"];

#[test]
fn axes_may_fall_and_be_logarithmic() {
    let folder = tempdir().unwrap();
    let axes = ["--x", "omega=5:2:4", "--y", "delta=0.01:1:7:log", "--out", "m.svg"];
    done(folder.path(), &[&TINY[..], &axes].concat());
    let svg = fs::read_to_string(folder.path().join("m.svg")).unwrap();
    let places = |label: &str| -> [f64; 2] {
        let line = svg.lines().find(|line| line.contains(&format!("aria-label=\"{label}\"")));
        let matrix = line.unwrap_or_else(|| panic!("no {label}")).split("matrix(").nth(1).unwrap();
        let numbers: Vec<f64> =
            matrix.split(')').next().unwrap().split(' ').map(|number| number.parse().unwrap()).collect();
        [numbers[4], numbers[5]]
    };
    assert!(places("4")[0] < places("2")[0], "as written");
    let [low, middle, high] = ["0.01", "0.1", "1"].map(|label| places(label)[1]);
    assert!((low - middle - (middle - high)).abs() < 2.0, "decades are equally high: {low} {middle} {high}");
    let config = svg.split("<metadata").nth(1).unwrap();
    assert!(config.contains("log"), "the axis reads back");
}

#[test]
fn a_map_of_few_cells_has_ticks_at_its_values() {
    let folder = tempdir().unwrap();
    let axes = ["--x", "omega=0.2:5:2", "--y", "delta=0.02:0.8:2", "--out", "m.svg"];
    done(folder.path(), &[&TINY[..], &axes].concat());
    let svg = fs::read_to_string(folder.path().join("m.svg")).unwrap();
    for label in ["0.2", "5", "0.02", "0.8"] {
        assert!(svg.contains(&format!("aria-label=\"{label}\"")), "{label}");
    }
    assert!(!svg.contains("aria-label=\"−"), "no frequency is negative");
}

#[test]
fn a_picture_without_room_for_its_legend_says_so() {
    let folder = tempdir().unwrap();
    let axes = ["--x", "omega=2:5:6", "--y", "delta=0.1:0.8:4"];
    let small = done(folder.path(), &[&TINY[..], &axes, &["--size", "200x150"]].concat());
    assert!(stderr(&small).contains("too small for the legend"), "{}", stderr(&small));
    let enough = stderr(&small).split("the legend").nth(1).unwrap().to_owned();
    let enough = enough.split_whitespace().find(|word| word.contains('x')).unwrap().to_owned();
    let whole =
        done(folder.path(), &[&TINY[..], &axes, &["--size", &enough, "--out", "w.svg", "--force"]].concat());
    assert!(!stderr(&whole).contains("too small"), "{}", stderr(&whole));
    assert!(fs::read_to_string(folder.path().join("w.svg")).unwrap().contains("aria-label=\"motion\""));
}

#[test]
fn the_papers_figures_are_made_once() {
    let folder = tempdir().unwrap();
    let arguments = ["reproduce", "--out", "paper", "--figure", "7", "--figure", "10"];
    let first = done(folder.path(), &arguments);
    let paper = folder.path().join("paper");
    assert_eq!(
        names(&paper),
        ["fig07.json", "fig07.png", "fig10.json", "fig10.png", "report.json", "report.md"]
    );
    assert!(!stderr(&first).contains("already there"));
    let report =
        || -> Value { serde_json::from_slice(&fs::read(paper.join("report.json")).unwrap()).unwrap() };
    let claims = report();
    let mut keys: Vec<&String> = claims[0].as_object().unwrap().keys().collect();
    keys.sort_unstable();
    assert_eq!(keys, ["claim", "computed", "figure", "note", "printed", "verdict"]);
    assert!(claims.as_array().unwrap().iter().all(|claim| claim["verdict"] == "agrees"), "{claims}");
    assert!(stdout(&first).starts_with("7 claims: 7 agree"), "{}", stdout(&first));

    // Nothing is made again, unless its picture is gone or was made with something else.
    let again = stderr(&done(folder.path(), &arguments));
    assert_eq!(again.matches("already there").count(), 2, "{again}");
    fs::remove_file(paper.join("fig07.png")).unwrap();
    let other = fs::read_to_string(paper.join("fig10.json")).unwrap().replacen(
        "\"omega\": 1.72",
        "\"omega\": 1.73",
        1,
    );
    fs::write(paper.join("fig10.json"), other).unwrap();
    let remade = stderr(&done(folder.path(), &arguments));
    assert!(!remade.contains("already there"), "{remade}");
    assert_eq!(report(), claims);
    assert_eq!(config_of_png(&paper.join("fig07.png"))["figure"], 7);

    // What is there is made again where that is asked for.
    let caption = |name: &str| -> Value {
        serde_json::from_slice::<Value>(&fs::read(paper.join(name)).unwrap()).unwrap()["caption"].clone()
    };
    let made = caption("fig10.json");
    let old = fs::read_to_string(paper.join("fig10.json")).unwrap().replacen(
        "\"caption\": \"",
        "\"caption\": \"Old. ",
        1,
    );
    fs::write(paper.join("fig10.json"), old).unwrap();
    let once = ["reproduce", "--out", "paper", "--figure", "10"];
    assert!(stderr(&done(folder.path(), &once)).contains("already there"));
    assert_ne!(caption("fig10.json"), made, "the negative control");
    let forced = stderr(&done(folder.path(), &[&once[..], &["--force"]].concat()));
    assert!(!forced.contains("already there"), "{forced}");
    assert_eq!(caption("fig10.json"), made);

    // A report covers whatever is there.
    let more = done(folder.path(), &["reproduce", "--out", "paper", "--figure", "11", "--json"]);
    let all: Value = serde_json::from_str(&stdout(&more)).unwrap();
    assert_eq!(all.as_array().unwrap().len(), 10);
    assert!(all.as_array().unwrap().iter().any(|claim| claim["verdict"] == "differs"));
    let svg = done(folder.path(), &["reproduce", "--out", "vectors", "--figure", "10", "--svg"]);
    assert!(!stderr(&svg).contains("already there"));
    assert_eq!(
        names(&folder.path().join("vectors")),
        ["fig10.json", "fig10.svg", "report.json", "report.md"]
    );
}

#[cfg(unix)]
#[test]
fn ctrl_c_leaves_whole_figures_alone() {
    let folder = tempdir().unwrap();
    let mut command = program();
    command.args(["reproduce", "--figure", "5", "--out", "paper"]).current_dir(folder.path());
    let mut child = command.stderr(std::process::Stdio::null()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(700));
    assert!(child.try_wait().unwrap().is_none(), "over too soon");
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(names(&folder.path().join("paper")), [""; 0]);
}

#[test]
fn figures_that_are_not_there_are_refused() {
    refuses(&["reproduce", "--figure", "4"], &["figure 4", "5, 6, 7"]);
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("file"), "kept").unwrap();
    let output = run_in(folder.path(), &["reproduce", "--figure", "7", "--out", "file"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("not a directory"), "{}", stderr(&output));
    assert_eq!(names(folder.path()), ["file"]);
}

#[test]
fn help_has_examples() {
    let folder = tempdir().unwrap();
    for command in ["orbit", "bifurcation", "reproduce"] {
        let text = stdout(&done(folder.path(), &[command, "--help"]));
        assert!(text.contains(&format!("  impact-atlas {command} --")), "{text}");
    }
}
