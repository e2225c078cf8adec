//! Streams, time, threads and limits.

use std::fs;
use std::io::Read;
use std::process::Stdio;
use std::time::Duration;

use tempfile::tempdir;

use crate::habits::SMALL;
use crate::run::{done, names, program, refuses, run, stderr, stdout, words};

#[test]
fn quiet_leaves_results_and_errors() {
    let output = run(&words("classify --backend cpu --quiet"));
    assert!(stdout(&output).starts_with("1-1-1") && output.stderr.is_empty(), "{}", stderr(&output));
    let refused = run(&words("-q classify --set r=2"));
    assert!(stderr(&refused).contains("r = 2"));
    assert!(!run(&words("classify --backend cpu")).stderr.is_empty());
}

/// Runs a command that takes long for so many seconds and gives what it said on standard error.
fn interrupted_after(seconds: u64, command: &str) -> String {
    let folder = tempdir().unwrap();
    let mut child = program();
    child.args(words(command)).current_dir(folder.path()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = child.spawn().unwrap();
    std::thread::sleep(Duration::from_secs(seconds));
    child.kill().unwrap();
    let mut said = String::new();
    child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
    child.wait().unwrap();
    said
}

#[test]
fn without_a_terminal_progress_is_lines() {
    let long = "classify --backend cpu --transient 1e8 --set omega=2.83";
    let said = interrupted_after(7, long);
    assert!(said.contains("following the trajectory: "), "{said}");
    assert!(!said.contains('\u{1b}') && !said.contains('\r'), "{said:?}");
    assert_eq!(interrupted_after(6, &format!("{long} --quiet")), "");
}

#[test]
fn what_will_take_long_is_announced() {
    // 10,000 cells of 30,100 forcing periods each; nothing finishes early.
    let plane = "--x omega=2:4:100 --y delta=0.05:0.3:100 --transient 3e4 --observe 100 --fixed-periods --backend cpu";
    let said = interrupted_after(6, &format!("map {plane} --threads 1"));
    let (_, announced) =
        ["will take about ", "may take "].iter().find_map(|words| said.split_once(words)).expect(&said);
    let seconds: f64 = announced.split(' ').next().unwrap().parse().unwrap();
    assert!(seconds > 10.0 || announced.contains("min") || announced.contains(" h "), "{announced}");
    assert!(announced.contains("of 10000 cells"), "{announced}");
    assert!(!stderr(&done(tempdir().unwrap().path(), SMALL)).contains(" take "));
    // Close to r = 1 at low frequency a mass rebounds a hundred thousand times in a period before it comes to rest.
    let slow = "map --backend cpu --threads 1 --x omega=0.01:0.02:30 --y r=0.999:1:20 --set delta=0.1";
    let said = interrupted_after(8, slow);
    assert!(said.contains("will take about") || said.contains("may take"), "{said}");
    assert!(said.contains(" of 600 cells"), "{said}");
}

#[test]
fn threads_are_as_many_as_there_can_be() {
    let with = |threads: &str, arguments: &str| {
        let folder = tempdir().unwrap();
        let mut command = program();
        command.args(words(arguments)).current_dir(folder.path()).env("RAYON_NUM_THREADS", threads);
        let output = command.output().unwrap();
        (output.status.code(), stderr(&output), names(folder.path()))
    };
    for threads in ["100000", "-3", "many", "99999999999999999999"] {
        let (code, message, names) = with(threads, SMALL);
        assert_eq!(code, Some(2), "{message}");
        assert!(message.contains(threads) && message.contains("--threads"), "{message}");
        assert_eq!(names, [""; 0]);
    }
    assert_eq!(with("100000", &format!("{SMALL} --threads 2")).0, Some(0));
    assert_eq!(with("1", SMALL).0, Some(0));
    refuses(&words("map --threads 0"), &["--threads", "1 to 1024"]);
    refuses(&words("classify --threads 1e5"), &["100000", "1 to 1024"]);
    // The number of threads changes nothing.
    let folder = tempdir().unwrap();
    done(folder.path(), &format!("{SMALL} --threads 1 --out a.png"));
    done(folder.path(), &format!("{SMALL} --threads 3 --out b.png"));
    assert_eq!(
        fs::read(folder.path().join("a.npz")).unwrap(),
        fs::read(folder.path().join("b.npz")).unwrap()
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_limit_on_the_size_of_files_is_an_error_of_writing() {
    let folder = tempdir().unwrap();
    // In units of 512 bytes (or 1024): less than the picture, more than nothing.
    let script = format!("ulimit -f 4; exec {} {SMALL}", env!("CARGO_BIN_EXE_impact-atlas"));
    let output =
        std::process::Command::new("sh").args(["-c", &script]).current_dir(folder.path()).output().unwrap();
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(3), "{message}");
    assert!(message.contains("limit on the size of files"), "{message}");
    assert!(!message.contains("ZipWriter") && !message.contains("panic"), "{message}");
    assert_eq!(names(folder.path()), [""; 0]);
    // An archive that does not fit is one error too.
    let many = "--x omega=2.8:3.8:60 --y delta=0.1:0.3:50 --size 64x64 --out -";
    let script = format!(
        "ulimit -f 16; exec {} map --backend cpu --transient 2 --observe 2 {many} --data m.npz > /dev/null",
        env!("CARGO_BIN_EXE_impact-atlas")
    );
    let output =
        std::process::Command::new("sh").args(["-c", &script]).current_dir(folder.path()).output().unwrap();
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(3), "{message}");
    assert!(message.contains("m.npz") && !message.contains("ZipWriter"), "{message}");
    assert_eq!(names(folder.path()), [""; 0]);
}

#[cfg(target_os = "linux")]
#[test]
fn drivers_say_nothing() {
    for arguments in ["adapters", "classify"] {
        let mut command = program();
        command.args(words(arguments)).env_remove("XDG_RUNTIME_DIR").env_remove("NODEVICE_SELECT");
        let output = command.output().unwrap();
        assert_eq!(output.status.code(), Some(0));
        assert!(!stderr(&output).contains("XDG_RUNTIME_DIR"), "{}", stderr(&output));
    }
}
