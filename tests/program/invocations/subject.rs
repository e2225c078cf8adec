//! The system of an invocation: the paper's, another that comes with the program, or one from a file.

use impact_atlas::system::{BUILTIN, Family};
use rand::Rng;
use rand::seq::IndexedRandom;

use super::{Random, chance, pick};

/// Files of one's own: a single oscillator driven by its wall, and three masses among four stops.
const OWN: [&str; 2] = [
    r#"
name = "Oscillator before a wall"
[parameters]
omega = { default = 1.3, above = 0 }
c = 0.1
e = { default = 0.8, at_least = 0, at_most = 1 }
wall = 0.4
[system]
frequency = "omega"
mass = [["1"]]
damping = [["c"]]
stiffness = [["1"]]
force_cos = ["1"]
[[stop]]
name = "wall"
direction = ["1"]
gap = "wall"
restitution = "e"
[plane]
x = "omega=0.5:3:9"
y = "wall=0:1:7"
"#,
    r#"
name = "Three masses among four stops"
label_order = ["low", "high", "left", "between"]
[parameters]
omega = { default = 1.75, above = 0 }
gap = 0.3
m = 0.8
r = { default = 0.7, at_least = 0, at_most = 1 }
[system]
frequency = "omega"
mass = [["1", "0", "0"], ["0", "m", "0"], ["0", "0", "1.3"]]
damping = [["0.3", "-0.1", "0"], ["-0.1", "0.3", "-0.1"], ["0", "-0.1", "0.3"]]
stiffness = [["2", "-1", "0"], ["-1", "2", "-1"], ["0", "-1", "2"]]
force_sin = ["1", "0.3", "0"]
force_cos = ["0", "0", "0.9"]
[[stop]]
name = "high"
direction = ["0", "1", "0"]
gap = "gap"
restitution = "r"
[[stop]]
name = "low"
direction = ["0", "-1", "0"]
gap = "gap"
restitution = "r"
[[stop]]
name = "between"
direction = ["1", "0", "-1"]
gap = 0.4
restitution = 0.9
[[stop]]
name = "left"
direction = ["-1", "0", "0"]
gap = 0.5
restitution = 0.6
"#,
];

/// The name under which a file of one's own lies in the folder of a run.
const FILE: &str = "own.toml";

/// What a file can be that is no system, and what is done to one that was.
const DAMAGES: [(&str, &str); 9] = [
    ("[system]", "[sistem]"),
    ("mass = ", "mass = 1 #"),
    ("stiffness", "stifness"),
    ("direction", "name"),
    ("default = ", "default = nan #"),
    ("restitution = ", "restitution = \"1/(r-r)\" #"),
    ("[[\"1\"", "[[\"0*omega\""),
    ("name = ", "= "),
    ("gap", "gqp"),
];

/// A system with what command lines can say of it.
#[derive(Clone, Debug)]
pub struct Subject {
    /// What is said of it: nothing for the paper's.
    pub option: String,
    /// The file that it is read from, by name and text.
    pub file: Option<(String, String)>,
    /// Whether it is a system at all.
    pub sound: bool,
    /// Names and defaults of the parameters.
    pub parameters: Vec<(String, f64)>,
    /// Names of the stops.
    pub stops: Vec<String>,
    /// Coordinates.
    pub n: usize,
}

impl Subject {
    /// The paper's half the time.
    pub fn random(random: &mut Random) -> Self {
        match random.random_range(0..16) {
            0..8 => Self::of(&Family::parse(BUILTIN[0].text, "own").unwrap(), String::new(), None),
            8..13 => {
                let builtin = BUILTIN.choose(random).unwrap();
                let family = Family::parse(builtin.text, "own").unwrap();
                Self::of(&family, format!("--system {}", builtin.name), None)
            }
            _ => Self::own(random),
        }
    }

    /// One from a file, now and then from a damaged one, or from one that is not there.
    fn own(random: &mut Random) -> Self {
        let text = pick(random, &OWN);
        let sound = Family::parse(text, FILE).expect("the file is sound");
        let option = format!("--system {FILE}");
        let subject = |text: String| {
            let is_sound = Family::parse(&text, FILE).is_ok();
            Subject { sound: is_sound, ..Self::of(&sound, option.clone(), Some((FILE.to_owned(), text))) }
        };
        match random.random_range(0..6) {
            0 => {
                let (piece, by) = DAMAGES.choose(random).unwrap();
                subject(text.replacen(piece, by, 1))
            }
            1 => {
                let lines: Vec<&str> = text.lines().collect();
                let cut = random.random_range(0..lines.len());
                subject([&lines[..cut], &lines[cut + 1..]].concat().join("\n"))
            }
            2 if chance(random, 2) => Subject {
                option: "--system nowhere.toml".to_owned(),
                sound: false,
                ..Self::of(&sound, String::new(), None)
            },
            _ => subject(text.to_owned()),
        }
    }

    fn of(family: &Family, option: String, file: Option<(String, String)>) -> Self {
        Subject {
            option,
            file,
            sound: true,
            parameters: family.parameters.iter().map(|p| (p.name.clone(), p.default)).collect(),
            stops: family.stops().iter().map(|stop| stop.plain_name().to_owned()).collect(),
            n: family.n(),
        }
    }

    /// The name of a parameter.
    pub fn parameter(&self, random: &mut Random) -> &str {
        &self.parameters.choose(random).unwrap().0
    }

    /// The name of a component of the start.
    pub fn component(&self, random: &mut Random) -> String {
        let letter = pick(random, &["x", "v"]);
        format!("{letter}{}", random.random_range(1..=self.n))
    }

    /// The name of a stop.
    pub fn stop(&self, random: &mut Random) -> &str {
        self.stops.choose(random).unwrap()
    }

    /// A value that everyday command lines give a parameter: not far from its default.
    pub fn everyday(&self, random: &mut Random, name: &str) -> f64 {
        match name {
            "omega" => random.random_range(0.3..5.0),
            "delta" => random.random_range(0.01..0.8),
            "zeta" => random.random_range(0.01..0.3),
            "f20" => random.random_range(0.0..1.0),
            "r" | "e" | "mu_m" | "mu_k" | "mu_c" => random.random_range(0.2..0.9),
            _ => {
                let default = self.parameters.iter().find(|(own, _)| own == name).map_or(1.0, |(_, d)| *d);
                default * random.random_range(0.5..1.6) + random.random_range(0.0..0.1)
            }
        }
    }

    /// A label: a number for every stop, or one too many.
    pub fn label(&self, random: &mut Random) -> String {
        let count = self.stops.len() + usize::from(chance(random, 10));
        let counts: Vec<String> = (0..count).map(|_| random.random_range(0..3).to_string()).collect();
        format!("{}-{}", random.random_range(0..3), counts.join("-"))
    }

    /// A state, of as many numbers as it has components.
    pub fn state(&self, random: &mut Random) -> String {
        let number = |_| format!("{:.3}", random.random_range(-0.3..0.1));
        (0..2 * self.n).map(number).collect::<Vec<_>>().join(",")
    }
}
