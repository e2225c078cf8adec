//! The program from outside, for every suite that runs it.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::tempdir;

pub fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_impact-atlas"))
}

pub fn run_in(folder: &Path, arguments: &[&str]) -> Output {
    program().args(arguments).current_dir(folder).output().unwrap()
}

pub fn run(arguments: &[&str]) -> Output {
    run_in(tempdir().unwrap().path(), arguments)
}

/// Runs a command, given in one line, that succeeds.
pub fn done(folder: &Path, command: &str) -> Output {
    let output = run_in(folder, &words(command));
    assert_eq!(output.status.code(), Some(0), "{command}: {}", stderr(&output));
    output
}

/// The arguments in a line.
pub fn words(command: &str) -> Vec<&str> {
    command.split_whitespace().collect()
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

pub fn json(output: &Output) -> Value {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
    serde_json::from_str(&stdout(output)).unwrap()
}

pub fn keys(value: &Value) -> Vec<&str> {
    let mut keys: Vec<&str> = value.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

pub fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort_unstable();
    names
}

/// Checks that the input is refused with all of `parts` in the message, and that nothing was written.
pub fn refuses(arguments: &[&str], parts: &[&str]) {
    let folder = tempdir().unwrap();
    let output = run_in(folder.path(), arguments);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    for part in parts {
        assert!(message.contains(part), "{arguments:?}: no `{part}` in {message}");
    }
    assert!(!message.contains("panicked"), "{message}");
    assert_eq!(stdout(&output), "", "{arguments:?}");
    assert_eq!(names(folder.path()), [""; 0], "{arguments:?}");
}
