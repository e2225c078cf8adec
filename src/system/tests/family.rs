//! A family gives plants: values, ranges, cells without one.

use super::super::{CellError, Family, Number, ParameterError, Plant};

/// The example of the documentation.
pub(super) fn example() -> &'static str {
    let page = include_str!("../format.md");
    let from = page.find("```toml\n").unwrap() + 8;
    &page[from..from + page[from..].find("```").unwrap()]
}

fn family() -> Family {
    Family::parse(example(), "example.toml").unwrap()
}

fn with(family: &Family, changes: &[(&str, f64)]) -> Vec<f64> {
    let mut values = family.defaults();
    for (name, value) in changes {
        values[family.find(name).unwrap().index()] = *value;
    }
    values
}

const RATIO: &str = r#"
name = "ratio"
[parameters]
omega = 1
m = { default = 0.5, above = 0 }
gap = { default = 1, below = 10 }
[system]
frequency = "omega"
mass = [[1, 0], [0, "m/(1 - m)"]]
damping = [[0, 0], [0, 0]]
stiffness = [["sqrt(2 - m)", 0], [0, 0x10]]
[[stop]]
name = "A"
direction = ["1", "0"]
gap = "gap"
restitution = 0.5
[[stop]]
name = "B"
direction = ["-1", "0"]
gap = 1
restitution = 0.5
"#;

#[test]
fn the_example_of_the_documentation_is_a_family() {
    let family = family();
    assert_eq!(family.name, "Single-sided impact oscillator");
    assert_eq!(family.source.as_deref(), Some("Shaw and Holmes, J. Sound Vib. 90 (1983)"));
    assert_eq!((&*family.origin, &*family.text), ("example.toml", example()));
    let names: Vec<&str> = family.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["omega", "zeta", "sigma", "r"], "in the order of the file");
    assert_eq!(family.defaults(), [2.8, 0.0, 0.0, 0.8]);
    let symbols: Vec<&str> = family.parameters.iter().map(|p| p.symbol.as_str()).collect();
    assert_eq!(symbols, ["ω", "zeta", "σ", "r"]);
    let omega = family.about(family.parameter("omega").unwrap());
    assert_eq!(omega.about, "forcing frequency");
    assert_eq!((family.n(), family.label_order(), family.stop("A")), (1, &[0][..], Some(0)));
    assert_eq!(family.stop("B"), None);
    let plane = family.plane.as_ref().unwrap();
    assert_eq!((plane.x.as_str(), plane.y.as_str()), ("omega=1:4:400", "sigma=-0.5:0.5:300"));
}

#[test]
fn values_reach_every_part_of_the_plant() {
    let family = family();
    let values = with(&family, &[("omega", 1.5), ("zeta", 0.25), ("sigma", -0.125), ("r", 0.5)]);
    let plant = family.plant(&values).unwrap();
    assert_eq!((plant.n, plant.omega), (1, 1.5));
    assert_eq!((plant.mass[0], plant.damping[0], plant.stiffness[0]), (1.0, 0.5, 1.0));
    assert_eq!((plant.force_sin[0], plant.force_cos[0], plant.load[0]), (0.0, 1.0, 0.0));
    let stop = &plant.stops[0];
    assert_eq!((stop.direction[0], stop.gap, stop.restitution), (1.0, -0.125, 0.5));
    assert_eq!(plant.mirror(), None);
}

#[test]
fn matrices_are_read_row_by_row_and_loads_default_to_zero() {
    let text = RATIO.replace("[[0, 0], [0, 0]]", "[[1, 2], [3, \"4*m\"]]");
    let plant = Family::parse(&text, "ratio.toml").unwrap();
    let plant: Plant = plant.plant(&plant.defaults()).unwrap();
    assert_eq!(plant.damping.row(0).iter().copied().collect::<Vec<_>>(), [1.0, 2.0]);
    assert_eq!(plant.damping.row(1).iter().copied().collect::<Vec<_>>(), [3.0, 2.0]);
    assert_eq!(plant.stiffness[(1, 1)], 16.0);
    assert!([&plant.force_sin, &plant.force_cos, &plant.load].iter().all(|load| load.amax() == 0.0));
    assert_eq!(plant.stops[1].direction.as_slice(), [-1.0, 0.0]);
}

#[test]
fn the_hash_is_that_of_the_text() {
    let text = example();
    let hash = |text: &str| Family::parse(text, "example.toml").unwrap().hash;
    assert_eq!(hash(text), hash(text));
    assert_ne!(hash(text), hash(&format!("{text}\n")));
    assert_eq!(hash(text).len(), 64);
    // What sha256sum prints for the text above.
    assert_eq!(hash(RATIO), RATIO_HASH);
}

const RATIO_HASH: &str = "382aff4a0f8ce704e4e2c9aa51d986b79bd6bfd497438028e5605733e4912ddf";

#[test]
fn values_out_of_range_are_refused_in_words() {
    let family = family();
    let refused = |name: &str, value: f64| family.plant(&with(&family, &[(name, value)])).unwrap_err();
    let cases = [
        ("omega", 0.0, "omega = 0 is out of range: omega must be greater than 0"),
        ("r", 1.5, "r = 1.5 is out of range: r must be between 0 and 1, ends included"),
        ("zeta", f64::NAN, "zeta = NaN is out of range: zeta must be a finite number"),
    ];
    for (name, value, message) in cases {
        let error = refused(name, value);
        assert!(matches!(error, CellError::Parameter(ParameterError::OutOfRange { .. })));
        assert_eq!(error.to_string(), message);
    }
    let unknown = family.find("omgea").unwrap_err().to_string();
    assert_eq!(unknown, "unknown parameter `omgea`; the parameters are omega, zeta, sigma, r");
}

/// Each cell without a plant names the place, the part and the values.
#[test]
fn cells_without_a_plant_say_what_did_it() {
    let family = Family::parse(RATIO, "ratio.toml").unwrap();
    assert!(family.plant(&family.defaults()).is_ok());
    let cases = [
        (vec![("m", 1.0)], "ratio.toml:9: system.mass[2][2]: `m/(1 - m)` divides by zero (at m = 1)"),
        (
            vec![("m", 3.0)],
            "ratio.toml:11: system.stiffness[1][1]: `sqrt(2 - m)` is not a number (NaN) (at m = 3)",
        ),
        (vec![("m", 1e-320)], "ratio.toml:9: system.mass: the mass matrix is so small"),
        (vec![("gap", -3.0)], "ratio.toml:20: stop[2].gap: no state satisfies the gaps of stops 1 and 2"),
        (
            vec![("omega", -1.0)],
            "ratio.toml:8: system.frequency: the frequency is -1, it must be greater than 0 (at omega = -1)",
        ),
    ];
    for (changes, beginning) in cases {
        let error = family.plant(&with(&family, &changes)).unwrap_err();
        assert!(matches!(error, CellError::Fault(_)));
        let message = error.to_string();
        assert!(message.starts_with(beginning), "{message}");
        assert!(message.ends_with("; choose other values"), "{message}");
        let (name, value) = changes[0];
        assert!(message.contains(&format!("(at {name} = {})", Number(value))), "{message}");
    }
    assert!(family.plant(&with(&family, &[("gap", -1.0)])).is_ok(), "closed stops clamp");
}

#[test]
fn matrices_go_row_by_row() {
    let text = RATIO.replace("[[0, 0], [0, 0]]", r#"[[1, 2], ["3*omega", 4]]"#);
    let family = Family::parse(&text, "ratio.toml").unwrap();
    let damping = family.plant(&family.defaults()).unwrap().damping;
    assert_eq!([(0, 0), (0, 1), (1, 0), (1, 1)].map(|place| damping[place]), [1.0, 2.0, 3.0, 4.0]);
}
