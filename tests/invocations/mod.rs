//! Random command lines: sensible ones most of the time, with values from everyday to absurd.

use rand::Rng;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;

type Random = ChaCha8Rng;

/// The commands, each as often as it is listed.
const COMMANDS: [&str; 14] = [
    "map",
    "map",
    "map",
    "classify",
    "classify",
    "orbit",
    "orbit",
    "control",
    "bifurcation",
    "symmetric",
    "motion",
    "lyapunov",
    "curves",
    "validate",
];

fn chance(random: &mut Random, of: u32) -> bool {
    random.random_range(0..of) == 0
}

fn pick<'a>(random: &mut Random, from: &[&'a str]) -> &'a str {
    from.choose(random).expect("there is something to choose from")
}

/// The arguments of one run.
pub fn invocation(random: &mut Random) -> Vec<String> {
    let command = pick(random, &COMMANDS);
    let mut line = vec![command.to_owned()];
    let mut say = |words: String| line.extend(words.split_whitespace().map(str::to_owned));
    match command {
        "map" => {
            let (control, axes) = plane(random);
            say(format!(
                "{control} {axes} {} {}",
                lengths(random, control.is_empty(), true),
                backend(random)
            ));
            say(if chance(random, 6) && control.is_empty() { "--curves".into() } else { String::new() });
            say(outputs(
                random,
                &["--out m.png", "--out m.svg", "--data d.npz", "--out -", "--size 300x200"],
            ));
        }
        "classify" => say(format!("{} {} {}", start(random), lengths(random, true, true), backend(random))),
        "orbit" => {
            let periods = count(random, 30);
            say(format!("{} --transient {} --periods {periods}", start(random), count(random, 200)));
            let panels = ["--out o.svg --panel strobe --section-periods 50", "--out o.png", "--impacts -"];
            say(outputs(
                random,
                &[&["--impacts i.csv", "--trajectory t.csv --samples 20"], &panels[..]].concat(),
            ));
        }
        "control" => {
            let method = method(random);
            say(format!(
                "{method} {} --from {} --iterates {}",
                start(random),
                count(random, 60),
                count(random, 200)
            ));
            say(outputs(random, &["--out c.svg", "--data c.npz", "--max-period 20", "--tolerance 1e-4"]));
        }
        "bifurcation" => {
            say(format!(
                "--x {} --transient {} --observe {}",
                axis(random, 12),
                count(random, 80),
                count(random, 30)
            ));
            let sweep = pick(random, &["", "--sweep both", "--sweep down", "--spectrum", "--section strobe"]);
            say(format!("{sweep} {}", backend(random)));
            say(outputs(random, &["--out b.svg", "--data b.npz", "--points 3"]));
        }
        "motion" => {
            let label =
                pick(random, &["", "--label 1-1-1", "--label 2-2-2", "--label 1-0-1", "--label 0-1-1"]);
            say(format!("{} {} {label}", start(random), lengths(random, false, true)));
        }
        "lyapunov" => say(format!(
            "{} --transient {} --observe {}",
            start(random),
            count(random, 200),
            count(random, 400)
        )),
        "curves" => {
            say(format!(
                "--x {} --y {} --transient {} --observe 40",
                axis(random, 6),
                axis(random, 6),
                count(random, 60)
            ));
            say(format!(
                "{} {}",
                pick(random, &["", "--max-period 1", "--cells 30"]),
                outputs(random, &["--out c.csv"])
            ));
            say("--backend cpu".into());
        }
        "validate" if chance(random, 3) => {
            say(format!(
                "--x {} --y {} --transient {} --observe 30",
                axis(random, 4),
                axis(random, 4),
                count(random, 60)
            ));
        }
        "validate" => say(format!("--backend cpu --x {}", axis(random, 4))),
        _ => {}
    }
    let sets = random.random_range(0..4);
    (0..sets).for_each(|_| say(format!("--set {}", assignment(random))));
    if chance(random, 4) && command != "orbit" {
        say("--json".into());
    }
    if chance(random, 12) {
        say(pick(random, &["--threads 2", "--threads 1", "--force", "--threads 0", "--nonsense"]).to_owned());
    }
    line
}

fn plane(random: &mut Random) -> (String, String) {
    let axes = |random: &mut Random, x: String| format!("--x {x} --y {}", axis(random, 5));
    if chance(random, 4) {
        let method = method(random);
        let setting = pick(
            random,
            &[
                "gain=0:0.9:4",
                "delay=1:4:4",
                "alpha=0:1:3",
                "target_tau=1:3:3",
                "target_v1=-0.5:-0.1:3",
                "gain=0:2:3",
            ],
        );
        let lengths = format!("--from {} --iterates {}", count(random, 40), count(random, 120));
        let x = if chance(random, 4) { axis(random, 4) } else { setting.to_owned() };
        return (format!("--control {method} {lengths}"), axes(random, x));
    }
    let x = axis(random, 5);
    (String::new(), axes(random, x))
}

fn method(random: &mut Random) -> String {
    let methods = [
        "delay",
        "delay --gain 0.4",
        "delay --delay 3",
        "pulse",
        "pulse --period 3",
        "pulse --target -0.3,0.01,0.02,1.7",
        "sine",
        "sine --convention force",
        "sine --convention force-local",
        "pulse --noise 0.01",
        "delay --set gain=0.3",
    ];
    let [method, options @ ..] = &pick(random, &methods).split(' ').collect::<Vec<_>>()[..] else {
        unreachable!("a method has a name")
    };
    format!("{method} {}", options.join(" "))
}

/// A value of a parameter: everyday, at the end of its range, tiny, huge, or none.
fn value(random: &mut Random, name: &str) -> String {
    let everyday = match name {
        "omega" => random.random_range(0.3..5.0),
        "delta" => random.random_range(0.01..0.8),
        "zeta" => random.random_range(0.01..0.3),
        "f20" => random.random_range(0.0..1.0),
        _ => random.random_range(0.2..0.9),
    };
    match random.random_range(0..14) {
        0 => pick(random, &["0", "1", "0.999999", "1e-3"]).to_owned(),
        1 => pick(random, &["1e-6", "20", "0.05", "-1", "1e300", "nan", "inf", "x", "", "1e-300", "-0"])
            .to_owned(),
        _ => format!("{everyday:.4}"),
    }
}

const PARAMETERS: [&str; 8] = ["omega", "delta", "zeta", "r", "mu_m", "mu_k", "mu_c", "f20"];

fn assignment(random: &mut Random) -> String {
    let name = pick(random, &PARAMETERS);
    let value = value(random, name);
    if chance(random, 25) {
        pick(random, &["omgea=1", "x1=0.1", "omega", "gain=0.3"]).into()
    } else {
        format!("{name}={value}")
    }
}

fn axis(random: &mut Random, most: u32) -> String {
    let name =
        if chance(random, 5) { pick(random, &["x1", "x2", "v1", "v2"]) } else { pick(random, &PARAMETERS) };
    let count = random.random_range(2..=most);
    let (a, b) = match name {
        "x1" => ("-0.01".to_owned(), "0.01".to_owned()),
        "x2" | "v1" | "v2" => ("-1".to_owned(), "1".to_owned()),
        _ => (value(random, name), value(random, name)),
    };
    let swapped = matches!((a.parse::<f64>(), b.parse::<f64>()), (Ok(a), Ok(b)) if a > b);
    let (first, last) = if swapped && !chance(random, 8) { (b, a) } else { (a, b) };
    match random.random_range(0..40) {
        0 => format!("{name}={first}:{last}"),
        1 => format!("{name}={first}:{last}:0"),
        _ => format!("{name}={first}:{last}:{count}"),
    }
}

/// A count: small, as people write it, or none.
fn count(random: &mut Random, most: u32) -> String {
    match random.random_range(0..16) {
        0 => pick(random, &["0", "1", "2", "1.5", "many", "1e1"]).to_owned(),
        _ => random.random_range(1..=most).to_string(),
    }
}

fn lengths(random: &mut Random, observe: bool, transient: bool) -> String {
    let mut words = Vec::new();
    if transient && observe {
        words.push(format!("--transient {}", count(random, 120)));
        words.push(format!("--observe {}", count(random, 60)));
    }
    if observe && chance(random, 8) {
        words.push(
            pick(random, &["--max-period 4", "--max-period 64", "--fixed-periods", "--max-period 0"])
                .to_owned(),
        );
    }
    words.join(" ")
}

fn start(random: &mut Random) -> String {
    let starts = [
        "",
        "",
        "--start symmetric",
        "--start=0,0.1,-0.2,0.05",
        "--start=0.5,0,0,0",
        "--start rest",
        "--start=1,2",
    ];
    pick(random, &starts).to_owned()
}

/// Mostly the CPU: a software adapter needs its time to begin.
fn backend(random: &mut Random) -> &'static str {
    if chance(random, 30) { "--backend gpu" } else { "--backend cpu" }
}

fn outputs(random: &mut Random, from: &[&str]) -> String {
    let some: Vec<&str> = from.iter().copied().filter(|_| chance(random, 3)).collect();
    let bad = ["--out no/such/f.png", "--out m.jpg", "--data x.png", "--out .", "--impacts i.npz"];
    if chance(random, 25) { pick(random, &bad).to_owned() } else { some.join(" ") }
}
