//! The program serving, until it is dropped.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::run::program;

/// A plane whose cells take a moment only.
pub const SMALL: &str =
    "--backend cpu --x omega=1.2:3.6:96 --y delta=0.08:0.3:72 --transient 80 --observe 48";

/// The program, serving a page.
pub struct Explorer {
    child: Child,
    /// The address of the page, with its token.
    pub address: String,
}

impl Explorer {
    /// Starts the program in a folder and waits for the address.
    pub fn start(folder: &Path, arguments: &str) -> Self {
        let mut child = program()
            .arg("explore")
            .args(arguments.split_whitespace())
            .current_dir(folder)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut address = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut address).unwrap();
        let address = address.trim().to_owned();
        assert!(address.starts_with("http://127.0.0.1:"), "{address:?}");
        Explorer { child, address }
    }

    /// The port.
    pub fn port(&self) -> u16 {
        self.address.split(['/', ':']).nth(4).unwrap().parse().unwrap()
    }

    /// The token.
    pub fn token(&self) -> &str {
        self.address.split('/').nth(3).unwrap()
    }

    /// Its memory in bytes.
    pub fn memory(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id())).unwrap();
        let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
        1024 * line.split_whitespace().nth(1).unwrap().parse::<u64>().unwrap()
    }

    /// The processor time that it has used, in clock ticks of a hundredth of a second.
    pub fn processor_time(&self) -> Duration {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.child.id())).unwrap();
        // The name, in brackets, may hold blanks; user and system time are the 12th and 13th words after it.
        let words: Vec<&str> = stat.rsplit_once(')').unwrap().1.split_whitespace().collect();
        Duration::from_millis(
            10 * words[11..13].iter().map(|ticks| ticks.parse::<u64>().unwrap()).sum::<u64>(),
        )
    }

    /// Presses Ctrl-C and waits for the end: the exit code, what was said, and how long it took.
    pub fn interrupt(mut self) -> (Option<i32>, String, Duration) {
        let began = Instant::now();
        let pid = self.child.id().to_string();
        assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
        let status = loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                break status;
            }
            assert!(began.elapsed() < Duration::from_secs(20), "it does not end");
            thread::sleep(Duration::from_millis(10));
        };
        let took = began.elapsed();
        let mut said = String::new();
        self.child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        (status.code(), said, took)
    }
}

impl Drop for Explorer {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
