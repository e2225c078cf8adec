//! The commands `symmetric`, `motion` and `lyapunov` from outside.

use std::process::Output;

use serde_json::Value;

use crate::run::{json, keys, names, program, refuses, run, run_in, stderr, stdout};

/// The arguments of a command, with parameters set.
fn with<'a>(command: &'a str, set: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    let set = set.iter().flat_map(|set| ["--set", set]);
    std::iter::once(command).chain(set).chain(more.iter().copied()).collect()
}

/// The JSON that a command prints, in which nothing is NaN.
fn result(command: &str, set: &[&str], more: &[&str]) -> Value {
    let mut arguments = with(command, set, more);
    arguments.push("--json");
    let output = run(&arguments);
    is_clean(&output);
    assert!(stderr(&output).contains("computing on cpu"), "{}", stderr(&output));
    json(&output)
}

/// The text that a command prints.
fn text(command: &str, set: &[&str], more: &[&str]) -> String {
    let output = run(&with(command, set, more));
    is_clean(&output);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    stdout(&output)
}

fn is_clean(output: &Output) {
    let all = stdout(output) + &stderr(output);
    assert!(!all.contains("NaN") && !all.contains("inf ") && !all.contains("panicked"), "{all}");
    assert!(!all.contains("-0.000000,") && !all.contains("-0.0,"), "{all}");
}

/// A request that cannot be met: exit code 1, a message with all of `parts`, and nothing on standard output.
fn is_hopeless(command: &str, set: &[&str], more: &[&str], parts: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(folder.path(), &with(command, set, more));
    let message = stderr(&output);
    is_clean(&output);
    assert_eq!(output.status.code(), Some(1), "{set:?} {more:?}: {message}");
    for part in parts {
        assert!(message.contains(part), "{set:?} {more:?}: no `{part}` in {message}");
    }
    assert_eq!(stdout(&output), "");
    assert_eq!(names(folder.path()), [""; 0]);
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

#[track_caller]
fn assert_close(value: &Value, expected: &[f64], tolerance: f64) {
    let found = numbers(value);
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance, "{found:?} is not {expected:?} within {tolerance}");
    }
}

/// Complex numbers are pairs, largest modulus first.
fn moduli(value: &Value) -> Vec<f64> {
    let moduli: Vec<f64> = value
        .as_array()
        .unwrap()
        .iter()
        .map(|pair| match numbers(pair)[..] {
            [re, im] => re.hypot(im),
            _ => panic!("{pair} is not a pair"),
        })
        .collect();
    assert_eq!(moduli.len(), 4);
    assert!(moduli.is_sorted_by(|a, b| a >= b), "{moduli:?}");
    moduli
}

#[test]
fn the_symmetric_motion_has_the_printed_digits() {
    let found = result("symmetric", &["omega=3.7", "delta=0.1"], &[]);
    assert_eq!(keys(&found), ["reason", "solutions"]);
    assert_eq!(found["reason"], Value::Null);
    let [first, second] = &found["solutions"].as_array().unwrap()[..] else { panic!("{found}") };
    let expected = [
        "half_multipliers",
        "impacts_per_stop",
        "label",
        "multipliers",
        "physical",
        "reason",
        "residual",
        "section",
        "section_names",
        "section_stop",
        "stable",
        "state",
    ];
    assert_eq!(keys(first), expected);
    assert_close(&first["section"], &[-0.345457, -0.006341, 0.021160, 1.802134], 1e-6);
    assert_eq!(
        (&first["physical"], &first["stable"], &first["reason"]),
        (&true.into(), &true.into(), &Value::Null)
    );
    for (half, whole) in moduli(&first["half_multipliers"]).iter().zip(moduli(&first["multipliers"])) {
        assert!((half * half - whole).abs() < 1e-12);
    }
    assert_eq!(second["stable"], false);
    let text = text("symmetric", &[], &[]);
    assert!(text.contains("1-1-1 symmetric, stable") && text.contains("v1+ -0.345456931"), "{text}");
}

#[test]
fn the_symmetric_motion_loses_stability_at_the_pitchfork() {
    let stable = |omega: &str| {
        let found = result("symmetric", &[omega], &[]);
        let leading = numbers(&found["solutions"][0]["half_multipliers"][0]);
        assert!(leading[0] < 0.0 && leading[1] == 0.0, "{leading:?}");
        assert_eq!(found["solutions"][0]["stable"], leading[0] > -1.0);
        leading[0] > -1.0
    };
    assert!(stable("omega=3.6908") && !stable("omega=3.6906"));
}

#[test]
fn solutions_that_are_not_physical_say_why_with_numbers() {
    let reasons = |set: &[&str]| {
        let found = result("symmetric", set, &[]);
        let solutions = found["solutions"].as_array().unwrap().clone();
        assert!(solutions.iter().all(|solution| solution["physical"] == solution["reason"].is_null()));
        assert!(
            solutions.iter().all(|solution| solution["physical"] == true || solution["stable"].is_null())
        );
        solutions.iter().map(|solution| solution["reason"].to_string()).collect::<Vec<_>>().join("\n")
    };
    let outwards = reasons(&["omega=2.83"]);
    assert!(outwards.contains("wrong velocity sign") && outwards.contains("v1 = 0.06194795"), "{outwards}");
    let through = reasons(&["omega=1"]);
    assert!(through.contains("crosses a stop") && through.contains("at phase"), "{through}");
    let dead = reasons(&["r=0"]);
    assert!(dead.contains("stop A"), "{dead}");
}

/// Where the matrix of the matching conditions has no inverse, the solutions are there all the same.
#[test]
fn conservative_and_resonant_motions_are_solved() {
    let conservative = result("symmetric", &["r=1", "zeta=0"], &[]);
    let resonant = result("symmetric", &["zeta=0", "omega=1.618033988749895"], &[]);
    let half_pi = std::f64::consts::FRAC_PI_2;
    for (found, solution, expected) in [
        (&conservative, 0, [-0.394536861, -0.005976267, 0.0, half_pi]),
        (&conservative, 1, [-0.045458036, -0.008257280, 0.0, 3.0 * half_pi]),
        (&resonant, 0, [-0.431469120, -0.016025659, -0.087266463, half_pi]),
    ] {
        let solution = &found["solutions"][solution];
        assert_eq!(solution["physical"], true, "{found}");
        for (k, value) in expected.iter().enumerate() {
            assert!((solution["section"][k].as_f64().unwrap() - value).abs() < 1e-8, "{found}");
        }
    }
}

#[test]
fn where_there_is_no_symmetric_motion_the_list_is_empty_and_says_why() {
    for (set, part) in [("delta=0", "delta = 0"), ("delta=5", "±5")] {
        let found = result("symmetric", &[set], &[]);
        assert_eq!(found["solutions"], Value::Array(Vec::new()));
        assert!(found["reason"].as_str().unwrap().contains(part), "{found}");
        assert!(text("symmetric", &[set], &[]).contains(part));
    }
}

const MOTION: [&str; 16] = [
    "half_multipliers",
    "impacts_per_stop",
    "label",
    "method",
    "multipliers",
    "n",
    "p",
    "q",
    "residual",
    "section",
    "section_names",
    "section_stop",
    "stable",
    "state",
    "sticking",
    "symmetric",
];

#[test]
fn the_motion_that_a_start_leads_to_is_solved() {
    let found = result("motion", &["omega=3.7"], &[]);
    assert_eq!(keys(&found), MOTION);
    assert_eq!(found["label"], "1-1-1");
    assert_eq!((&found["n"], &found["p"], &found["q"]), (&1.into(), &1.into(), &1.into()));
    assert_eq!(
        (&found["symmetric"], &found["stable"], &found["section_stop"]),
        (&true.into(), &true.into(), &"A".into())
    );
    assert_close(&found["section"], &[-0.345457, -0.006341, 0.021160, 1.802134], 1e-6);
    assert!(found["residual"].as_f64().unwrap() < 1e-11);
    moduli(&found["multipliers"]);
    for (omega, label, symmetric) in
        [("3.5", "1-1-1", false), ("2.95", "2-2-2", false), ("1.72", "1-2-2", true), ("1.63", "2-4-4", false)]
    {
        let omega = format!("omega={omega}");
        let found = result("motion", &[&omega], &[]);
        assert_eq!((&found["label"], &found["symmetric"]), (&label.into(), &symmetric.into()), "{omega}");
        assert_eq!(found["half_multipliers"].is_null(), !symmetric, "{omega}");
        assert_eq!(found["stable"], true, "{omega}");
        assert!(text("motion", &[&omega], &[]).starts_with(label));
        // It is the motion that `classify` sees, at phase 0 of one of its periods.
        let seen = json(&run(&with(
            "classify",
            &[&omega],
            &["--start", "rest", "--backend", "cpu", "--transient", "20000", "--fixed-periods", "--json"],
        )));
        if found["n"] == 1 {
            assert_close(&found["state"], &numbers(&seen["state"]), 1e-6);
        }
    }
}

#[test]
fn unstable_motions_are_found_by_their_label() {
    let found = result("motion", &["omega=2.83"], &["--label", "1-2-1"]);
    assert_eq!((&found["label"], &found["stable"]), (&"1-2-1".into(), &false.into()));
    assert_close(&found["section"], &[-0.41959403, -0.02899702, 0.02903494, 1.80721094], 1e-7);
    let pairs = found["multipliers"].as_array().unwrap();
    for (pair, expected) in pairs.iter().zip([-1.4954, -0.6637, -0.5644, -0.1235]) {
        assert_close(pair, &[expected, 0.0], 5e-5);
    }
    let text = text("motion", &["omega=2.83"], &["--label", "1-2-1"]);
    assert!(text.starts_with("1-2-1, unsymmetric, unstable"), "{text}");
}

#[test]
fn a_motion_at_one_stop_only_has_its_section_there() {
    // Mirrored motions: one strikes stop A only, the other stop B only.
    let set = ["mu_k=0.95", "mu_m=0.8", "zeta=0.02", "r=0.6", "omega=0.8182", "delta=1.4263"];
    let found = |label: &str| result("motion", &set, &["--label", label]);
    let (at_a, at_b) = (found("1-0-1"), found("1-1-0"));
    assert_eq!((&at_a["section_stop"], &at_b["section_stop"]), (&"A".into(), &"B".into()));
    assert!(numbers(&at_a["section"])[0] < 0.0 && numbers(&at_b["section"])[0] > 0.0);
    assert!(text("motion", &set, &["--label", "1-1-0"]).contains("stop A is never struck"));
}

#[test]
fn sticking_motions_are_solved_on_the_strobe_map() {
    let found = result("motion", &["omega=0.25", "delta=0.545"], &[]);
    assert_eq!(keys(&found), MOTION);
    assert_eq!(found["label"], "1-∞-∞");
    assert_eq!((&found["n"], &found["p"], &found["q"]), (&1.into(), &65535.into(), &65535.into()));
    assert_eq!(
        (&found["sticking"], &found["symmetric"], &found["stable"]),
        (&true.into(), &true.into(), &true.into())
    );
    assert_eq!(found["section_stop"], "A");
    let moduli = moduli(&found["multipliers"]);
    assert!(moduli[0] > 1e-4 && moduli[2] < 1e-15, "two directions are forgotten: {moduli:?}");
    // The logarithms of the others are the exponents.
    let spectrum = result("lyapunov", &["omega=0.25", "delta=0.545"], &["--observe", "160"]);
    for j in 0..2 {
        let exponent = spectrum["exponents_per_period"][j].as_f64().unwrap();
        assert!((moduli[j].ln() - exponent).abs() < 1e-6, "{moduli:?} {exponent}");
    }
}

#[test]
fn hopeless_requests_say_what_the_start_leads_to() {
    is_hopeless("motion", &["omega=2.83"], &[], &["chaos", "--label"]);
    is_hopeless("motion", &["omega=2.83"], &["--json"], &["chaos", "--start"]);
    is_hopeless(
        "motion",
        &["omega=3.03"],
        &["--transient", "5000", "--observe", "2000"],
        &["quasi-periodic", "--label"],
    );
    is_hopeless("motion", &["delta=5"], &[], &["without impact", "--start"]);
    is_hopeless(
        "motion",
        &["omega=3.7"],
        &["--transient", "0", "--observe", "5"],
        &["no period", "--transient"],
    );
    is_hopeless(
        "motion",
        &[],
        &["--label", "1-7-2", "--transient", "50", "--observe", "100"],
        &["1-7-2", "--start"],
    );
    let ceased = ["--start", "0.1,1,1,1"];
    is_hopeless("motion", &["delta=0.7", "omega=2"], &ceased, &["without impact"]);
    // To and fro between two stops, at once and without loss.
    let endless = ["r=1", "zeta=0", "delta=1e-6", "omega=0.05"];
    let fast = ["--start", "0,0,1,0"];
    is_hopeless("motion", &endless, &fast, &["given up", "less restitution"]);
    is_hopeless("motion", &endless, &[&fast[..], &["--label", "1-3-3"]].concat(), &["1-3-3"]);
    is_hopeless("lyapunov", &endless, &fast, &["given up"]);
    is_hopeless("motion", &["delta=0"], &["--label", "1-1-1"], &["1-1-1"]);
}

#[test]
fn exponents_have_three_units_and_their_sum_is_known() {
    let found = result("lyapunov", &["omega=2.83"], &["--observe", "20000"]);
    let expected = [
        "exponents_per_iterate",
        "exponents_per_period",
        "exponents_per_time",
        "impacts",
        "impacts_per_stop",
        "iterates",
        "lost_directions",
        "period",
        "periods",
        "standard_error",
        "standard_error_per_time",
        "sum_identity",
        "sum_per_period",
    ];
    assert_eq!(keys(&found), expected);
    assert_close(&found["exponents_per_time"], &[0.156, -0.193, -0.257, -0.887], 0.012);
    let per_iterate = numbers(&found["exponents_per_iterate"]);
    assert!((per_iterate[0] - 0.18).abs() < 0.02, "{per_iterate:?}");
    let per_period = numbers(&found["exponents_per_period"]);
    let (iterates, periods) = (found["iterates"].as_f64().unwrap(), found["periods"].as_f64().unwrap());
    assert_close(
        &found["exponents_per_iterate"],
        &per_period.iter().map(|e| e * periods / iterates).collect::<Vec<_>>(),
        1e-12,
    );
    let (sum, identity) =
        (found["sum_per_period"].as_f64().unwrap(), found["sum_identity"].as_f64().unwrap());
    assert!((sum - identity).abs() < 1e-9, "{sum} {identity}");
    assert_eq!(found["lost_directions"], 0);

    let circle = result("lyapunov", &["omega=3.03"], &["--transient", "3000"]);
    let error = numbers(&circle["standard_error"])[0];
    assert!(numbers(&circle["exponents_per_period"])[0].abs() < 4.0 * error + 1e-4, "{circle}");
    assert!(text("lyapunov", &[], &["--observe", "160"]).contains("sum per period"));
}

#[test]
fn lost_directions_are_null_and_said_in_words() {
    let null = Value::Null;
    let found = result("lyapunov", &["omega=0.25", "delta=0.545"], &["--observe", "160"]);
    assert_eq!(found["lost_directions"], 2);
    assert_eq!((&found["exponents_per_period"][2], &found["exponents_per_time"][3]), (&null, &null));
    assert_eq!((&found["standard_error"][2], &found["sum_identity"]), (&null, &null));
    assert_eq!((&found["exponents_per_iterate"], &found["iterates"]), (&null, &null));
    assert!(found["exponents_per_period"][1].is_f64());
    let words = text("lyapunov", &["omega=0.25", "delta=0.545"], &["--observe", "160"]);
    assert!(words.contains("lost") && words.contains("complete chatter"), "{words}");

    let dead = result("lyapunov", &["omega=4", "r=0"], &["--observe", "160"]);
    assert_eq!((&dead["lost_directions"], &dead["exponents_per_period"][3]), (&1.into(), &null));
    assert!(dead["exponents_per_iterate"][2].is_f64(), "{dead}");
    assert!(text("lyapunov", &["omega=4", "r=0"], &["--observe", "160"]).contains("without rebound"));

    let quiet = result("lyapunov", &["delta=5"], &["--observe", "160"]);
    assert_eq!((&quiet["iterates"], &quiet["exponents_per_iterate"]), (&0.into(), &null));
    assert!(text("lyapunov", &["delta=5"], &["--observe", "160"]).contains("no return to stop A"));
}

/// At the ends of the parameters' ranges every command gives a result or says why not.
#[test]
fn the_ends_of_the_ranges_are_served() {
    for set in [
        &["delta=0"][..],
        &["r=0"],
        &["r=1"],
        &["r=1", "zeta=0"],
        &["zeta=0"],
        &["zeta=0", "omega=0.6180339887498949"],
        &["zeta=3"],
        &["zeta=3", "mu_c=0.9"],
        &["f20=1"],
        &["delta=100"],
        &["delta=1e-6"],
        &["omega=30"],
        &["mu_m=0.01", "mu_k=0.99"],
    ] {
        result("symmetric", set, &[]);
        text("symmetric", set, &[]);
        for command in ["motion", "lyapunov"] {
            let brief = ["--transient", "200", "--observe", "100"];
            let output = run(&with(command, set, &[&brief[..], &["--json"]].concat()));
            is_clean(&output);
            match output.status.code() {
                Some(0) => drop(json(&output)),
                Some(1) => assert!(
                    stdout(&output).is_empty() && stderr(&output).contains("--"),
                    "{}",
                    stderr(&output)
                ),
                code => panic!("{set:?}: {code:?}: {}", stderr(&output)),
            }
        }
    }
}

#[test]
fn bad_input_is_refused() {
    for command in ["symmetric", "motion", "lyapunov"] {
        refuses(&[command, "--set", "gamma=1"], &["gamma", "omega, delta"]);
        refuses(&[command, "--set", "r=1.5"], &["r = 1.5", "between 0 and 1"]);
        refuses(&[command, "--set", "omega=nan"], &["omega = NaN"]);
        refuses(&[command, "--set", "omega=1e-9"], &["raise omega"]);
        refuses(&[command, "--set", "r=0.5", "--set", "r=0.6"], &["twice"]);
        refuses(&[command, "--no-such-option"], &["--no-such-option"]);
    }
    for command in ["motion", "lyapunov"] {
        refuses(&[command, "--start", "0.2,0,0,0"], &["x1 = 0.2", "gap is 0.1"]);
        refuses(&[command, "--start", "0,NaN,0,0"], &["not a finite number"]);
        refuses(&[command, "--observe", "0"], &["0 forcing periods", "1 to"]);
        refuses(&[command, "--transient", "4000000000"], &["4000000000", "at most"]);
    }
    for (label, part) in [
        ("1-1", "N-p-q"),
        ("one", "N-p-q"),
        ("1-1-1-1", "N-p-q"),
        ("1--1-1", "N-p-q"),
        ("-1-1-1", "N-p-q"),
        ("0-1-1", "1 to 1024"),
        ("2000-1-1", "1 to 1024"),
        ("1-0-0", "without impact"),
        ("1-∞-∞", "infinitely many"),
        ("1-65535-1", "infinitely many"),
        ("1-9999-9999", "too many"),
    ] {
        refuses(&["motion", "--label", label], &[label, part]);
    }
    refuses(&["motion", "--label", "1-1-1", "--max-period", "4"], &["--max-period", "--label"]);
    refuses(&["motion", "--max-period", "0"], &["largest period of 0"]);
}

#[test]
fn help_has_examples_and_units() {
    for command in ["symmetric", "motion", "lyapunov"] {
        let help = stdout(&run(&[command, "--help"]));
        assert!(help.contains(&format!("  impact-atlas {command}")), "{help}");
    }
    let help = stdout(&run(&["lyapunov", "--help"])).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(help.contains("standard error is per forcing period"), "{help}");
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_them() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    for command in ["motion", "lyapunov"] {
        let mut child = program()
            .args([command, "--set", "omega=2.83", "--transient", "100000000"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(700));
        assert!(child.try_wait().unwrap().is_none(), "{command} was over too soon");
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
        let asked = Instant::now();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130), "{command}: {}", stderr(&output));
        assert!(asked.elapsed() < Duration::from_secs(20));
        assert_eq!(stdout(&output), "");
    }
}
