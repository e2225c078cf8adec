//! Parameters at the ends of their ranges, from outside: refused, or computed with; and every command can be ended.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::tempdir;

use crate::run::{program, refuses, run, stderr, stdout};

/// The commands that follow one system.
const COMMANDS: [&str; 3] = ["symmetric", "classify", "lyapunov"];

#[test]
fn what_cannot_be_computed_with_is_refused_by_value_and_remedy() {
    for command in COMMANDS {
        for mu_m in ["1e-50", "1e-100", "1e-300"] {
            refuses(&[command, "--set", &format!("mu_m={mu_m}")], &[&format!("mu_m = {mu_m}"), "raise mu_m"]);
        }
        // Below the smallest mass that has a reciprocal there is no mass matrix at all.
        refuses(&[command, "--set", "mu_m=5e-324"], &["mu_m = 5e-324", "mass matrix", "choose other values"]);
        refuses(&[command, "--set", "zeta=1e100"], &["zeta = 1e100", "lower zeta"]);
        // Twice this damping is no number.
        refuses(
            &[command, "--set", "zeta=1e308"],
            &["zeta = 1e308", "too large a number", "choose other values"],
        );
        refuses(
            &[command, "--set", "delta=1e300"],
            &["delta = 1e300", "out of all motion's reach", "choose other"],
        );
        refuses(&[command, "--set", "omega=1e-300"], &["omega = 1e-300", "raise omega"]);
        refuses(&[command, "--set", "omega=1e300"], &["omega = 1e300", "between 0 and 1000000"]);
        refuses(&[command, "--set", "mu_k=0.9999999999999999"], &["mu_k = 0.9999999999999999", "lower mu_k"]);
        refuses(&[command, "--set", "mu_c=0.9999999999999999"], &["mu_c = 0.9999999999999999", "lower mu_c"]);
    }
}

#[test]
fn ends_of_the_ranges_end_in_numbers() {
    let ends = [
        "omega=1e6",
        "delta=1e-300",
        "delta=5e-324",
        "delta=1e17",
        "zeta=1e-300",
        "zeta=30",
        "mu_m=1e-4",
        "mu_m=0.9999999",
        "mu_k=1e-300",
        "mu_k=0.9999",
        "mu_c=1e-300",
        "mu_c=0.9999",
    ];
    for end in ends {
        for command in ["symmetric", "classify"] {
            let began = Instant::now();
            let mut arguments = vec![command, "--set", end];
            arguments.extend(
                ["--transient", "20", "--observe", "20", "--backend", "cpu"]
                    .iter()
                    .filter(|_| command == "classify"),
            );
            let output = run(&arguments);
            assert!(matches!(output.status.code(), Some(0..=2)), "{arguments:?}: {}", stderr(&output));
            for no_number in ["NaN", "inf", "panicked"] {
                let said = stdout(&output) + &stderr(&output);
                assert!(!said.contains(no_number), "{arguments:?}: {said}");
            }
            assert!(began.elapsed() < Duration::from_secs(20), "{arguments:?}");
        }
    }
}

fn wait(child: &mut Child, arguments: &[&str]) -> Option<i32> {
    let began = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status.code();
        }
        if began.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
            panic!("{arguments:?} goes on");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[cfg(unix)]
#[test]
fn every_command_that_takes_long_can_be_ended() {
    let long = ["--set", "omega=2.83", "--transient", "100000000"];
    let commands: [&[&str]; 5] = [
        &["classify", "--backend", "cpu"],
        &["motion"],
        &["lyapunov"],
        &["orbit"],
        &["curves", "--cells", "10000000"],
    ];
    for command in commands {
        for signal in ["-INT", "-TERM"] {
            let folder = tempdir().unwrap();
            let given: &[&str] = if command[0] == "curves" { &[] } else { &long };
            let arguments = [command, given].concat();
            let mut running = program();
            running.args(&arguments).current_dir(folder.path());
            let mut child = running.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            std::thread::sleep(Duration::from_millis(500));
            assert_eq!(child.try_wait().unwrap(), None, "{arguments:?} was over too soon");
            let id = child.id().to_string();
            assert!(Command::new("kill").args([signal, &id]).status().unwrap().success());
            assert_eq!(wait(&mut child, &arguments), Some(130), "{arguments:?}");
            assert_eq!(crate::run::names(folder.path()), [""; 0], "{arguments:?}");
        }
    }
}
