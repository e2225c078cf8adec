//! Random command lines: sensible ones most of the time, with values from everyday to absurd.

mod subject;

use rand::Rng;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;
pub use subject::Subject;

type Random = ChaCha8Rng;

/// The commands, each as often as it is listed.
const COMMANDS: [&str; 18] = [
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
    "render",
    "status",
    "again",
    "systems",
];

fn chance(random: &mut Random, of: u32) -> bool {
    random.random_range(0..of) == 0
}

fn pick<'a>(random: &mut Random, from: &[&'a str]) -> &'a str {
    from.choose(random).expect("there is something to choose from")
}

/// One run: the files that it finds, the run that came before it, and what it is asked.
#[derive(Clone, Debug)]
pub struct Invocation {
    /// A file that lies in its folder, by name and text.
    pub file: Option<(String, String)>,
    /// Arguments of a run whose results it finds there; none where there are none.
    pub before: Vec<String>,
    /// Its own arguments.
    pub arguments: Vec<String>,
}

/// A random run.
pub fn invocation(random: &mut Random) -> Invocation {
    let subject = Subject::random(random);
    let command = pick(random, &COMMANDS);
    let (before, arguments) = match command {
        "render" | "status" | "again" if subject.sound => afterwards(random, &subject, command),
        "render" | "status" | "again" | "systems" => (Vec::new(), words(&about(random))),
        _ => (Vec::new(), computing(random, &subject, command)),
    };
    Invocation { file: subject.file, before, arguments }
}

fn words(line: &str) -> Vec<String> {
    line.split_whitespace().map(str::to_owned).collect()
}

/// Arguments of commands that compute nothing, and of some about files that are not there.
fn about(random: &mut Random) -> String {
    let lines = [
        "systems",
        "systems --json",
        "systems impact-damper",
        "systems no-such",
        "adapters",
        "completions zsh",
        "completions no-such",
        "man",
        "man curves",
        "man no-such",
        "status nowhere.zarr",
        "render nowhere.npz --out r.png",
        "classify --from nowhere.png --at omega=1,delta=1",
        "map --from nowhere.npz",
        "curves --help",
        "--version",
        "no-such",
    ];
    pick(random, &lines).to_owned()
}

/// A small map, and what is done with its files.
fn afterwards(random: &mut Random, subject: &Subject, command: &str) -> (Vec<String>, Vec<String>) {
    let axis = |name: &str, subject: &Subject| {
        let default = subject.parameters.iter().find(|(own, _)| own == name).map_or(1.0, |(_, d)| *d);
        format!("{name}={}:{}:4", default, 1.1 * default + 0.05)
    };
    let [(x, _), .., (y, _)] = &subject.parameters[..] else { unreachable!("two parameters at least") };
    let data = if command == "status" || chance(random, 2) { "d.zarr" } else { "d.npz" };
    let before = format!(
        "map {} --backend cpu --x {} --y {} --transient 40 --observe 20 --out d.png --data {data} --size 300x200",
        subject.option,
        axis(x, subject),
        axis(y, subject)
    );
    let after = match command {
        "status" => pick(random, &["status d.zarr", "status d.zarr --json", "status d.png"]).to_owned(),
        "render" => {
            let layer = pick(random, &["motion", "lyapunov", "n", "power", "contact", "settling", "no-such"]);
            let more =
                pick(random, &["", "--palette magma", "--range 0:1", "--x 0:100", "--title T", "--range 1"]);
            let out = pick(random, &["r.png", "r.svg", "r.pdf", "r.jpg", "d.png", "d.png --force"]);
            format!("render {data} --layer {layer} {more} --size 300x200 --out {out}")
        }
        _ => {
            let from = pick(random, &["d.png", data, "own.toml"]);
            let value =
                |name: &str| subject.parameters.iter().find(|(own, _)| own == name).map_or(9.0, |p| p.1);
            let lines = [
                format!("classify --from {from} --at {x}={},{y}={}", value(x), value(y)),
                format!("classify --from {from} --at {x}=9e9,{y}=0 --json"),
                format!("classify --from {from} --at {x}=0"),
                format!("map --from {from} --out again.png"),
                format!("map --from {from} --set {x}=1 --out again.svg"),
                format!("map --from {from} --certify --out d.png"),
            ];
            lines.choose(random).expect("there are some").clone()
        }
    };
    (words(&before), words(&after))
}

/// The arguments of a run that computes.
fn computing(random: &mut Random, subject: &Subject, command: &str) -> Vec<String> {
    let mut line = vec![command.to_owned()];
    let mut say = |words: String| line.extend(words.split_whitespace().map(str::to_owned));
    match command {
        "map" => {
            let (control, axes) = plane(random, subject);
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
        "classify" => {
            say(format!("{} {} {}", start(random, subject), lengths(random, true, true), backend(random)))
        }
        "orbit" => {
            let periods = count(random, 30);
            say(format!("{} --transient {} --periods {periods}", start(random, subject), count(random, 200)));
            let stop = subject.stop(random);
            let gap = format!("--out o.svg --panel time:gap.{stop} --panel section:tau,v_after");
            let panels =
                ["--out o.svg --panel strobe --section-periods 50", &gap, "--out o.png", "--impacts -"];
            say(outputs(
                random,
                &[&["--impacts i.csv", "--trajectory t.csv --samples 20"], &panels[..]].concat(),
            ));
        }
        "control" => {
            let method = method(random, subject);
            say(format!(
                "{method} {} --from {} --iterates {}",
                start(random, subject),
                count(random, 60),
                count(random, 200)
            ));
            say(outputs(random, &["--out c.svg", "--data c.npz", "--max-period 20", "--tolerance 1e-4"]));
        }
        "bifurcation" => {
            say(format!(
                "--x {} --transient {} --observe {}",
                axis(random, subject, 12),
                count(random, 80),
                count(random, 30)
            ));
            let (stop, reading) = (subject.stop(random), subject.component(random));
            let section = format!("--section {stop} --record {reading} --spectrum=iterate");
            let sweep = pick(
                random,
                &["", "--sweep both", "--sweep down", "--spectrum", "--section strobe", &section],
            );
            say(format!("{sweep} {}", backend(random)));
            say(outputs(random, &["--out b.svg", "--data b.npz", "--points 3"]));
        }
        "motion" => {
            let label =
                if chance(random, 5) { String::new() } else { format!("--label {}", subject.label(random)) };
            say(format!("{} {} {label}", start(random, subject), lengths(random, false, true)));
        }
        "lyapunov" => say(format!(
            "{} --transient {} --observe {}",
            start(random, subject),
            count(random, 200),
            count(random, 400)
        )),
        "curves" => {
            say(format!(
                "--x {} --y {} --transient {} --observe 40",
                axis(random, subject, 6),
                axis(random, subject, 6),
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
                axis(random, subject, 4),
                axis(random, subject, 4),
                count(random, 60)
            ));
        }
        "validate" => say(format!("--backend cpu --x {}", axis(random, subject, 4))),
        _ => {}
    }
    say(subject.option.clone());
    let sets = random.random_range(0..4);
    (0..sets).for_each(|_| say(format!("--set {}", assignment(random, subject))));
    if chance(random, 4) && command != "orbit" {
        say("--json".into());
    }
    if chance(random, 12) {
        say(pick(random, &["--threads 2", "--threads 1", "--force", "--threads 0", "--nonsense"]).to_owned());
    }
    line
}

fn plane(random: &mut Random, subject: &Subject) -> (String, String) {
    let axes = |random: &mut Random, x: String| format!("--x {x} --y {}", axis(random, subject, 5));
    if chance(random, 4) {
        let method = method(random, subject);
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
        let x = if chance(random, 4) { axis(random, subject, 4) } else { setting.to_owned() };
        return (format!("--control {method} {lengths}"), axes(random, x));
    }
    let x = axis(random, subject, 5);
    (String::new(), axes(random, x))
}

fn method(random: &mut Random, subject: &Subject) -> String {
    let (stop, state) = (subject.stop(random), subject.state(random));
    let own = [
        format!("delay --stop {stop}"),
        format!("pulse --stop {stop} --target={state}"),
        format!("sine --stop {stop} --convention force --coordinate x{}", subject.n),
    ];
    let methods = [
        &own[0],
        &own[1],
        &own[2],
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
fn value(random: &mut Random, subject: &Subject, name: &str) -> String {
    let everyday = subject.everyday(random, name);
    match random.random_range(0..14) {
        0 => pick(random, &["0", "1", "0.999999", "1e-3"]).to_owned(),
        1 => pick(random, &["1e-6", "20", "0.05", "-1", "1e300", "nan", "inf", "x", "", "1e-300", "-0"])
            .to_owned(),
        _ => format!("{everyday:.4}"),
    }
}

fn assignment(random: &mut Random, subject: &Subject) -> String {
    let name = subject.parameter(random);
    let value = value(random, subject, name);
    if chance(random, 25) {
        pick(random, &["omgea=1", "x1=0.1", "omega", "gain=0.3"]).into()
    } else {
        format!("{name}={value}")
    }
}

fn axis(random: &mut Random, subject: &Subject, most: u32) -> String {
    let name =
        if chance(random, 5) { subject.component(random) } else { subject.parameter(random).to_owned() };
    let count = random.random_range(2..=most);
    let (a, b) = match &*name {
        "x1" => ("-0.01".to_owned(), "0.01".to_owned()),
        "x2" | "x3" | "v1" | "v2" | "v3" => ("-1".to_owned(), "1".to_owned()),
        _ => (value(random, subject, &name), value(random, subject, &name)),
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

fn start(random: &mut Random, subject: &Subject) -> String {
    let own = format!("--start={}", subject.state(random));
    let starts = [
        &own,
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
