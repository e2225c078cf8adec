//! Progress with the time left, for what takes long: a bar on a terminal, now and then a line elsewhere.

use std::io::{self, IsTerminal};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use impact_atlas::backend::Watch;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::terminal::{complain, is_quiet};
use super::{interrupt, spans};

/// What is done sooner shows no bar.
const DELAY: Duration = Duration::from_secs(1);

const REDRAW: Duration = Duration::from_millis(250);

/// The time before the first line where there is no terminal; each next one comes after twice as long as the last.
const FIRST_LINE: Duration = Duration::from_secs(5);

const LONGEST_SILENCE: Duration = Duration::from_secs(60);

const CELLS: &str = "{msg} {bar:30} {percent:>3} % of {human_len} cells, {eta} left";

const UNKNOWN: &str = "{spinner} {msg}, {elapsed}";

/// A bar on standard error that goes away when it is dropped; it also hands on Ctrl-C.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    reveal: Option<Reveal>,
}

impl Progress {
    /// The progress of so many cells.
    pub fn of_cells(message: &str, cells: u64) -> Self {
        Progress::new(Some(cells), CELLS, message)
    }

    /// A sign of life while one trajectory is followed.
    pub fn of_trajectory() -> Self {
        // It may settle at any time.
        Progress::of_unknown("following the trajectory")
    }

    /// A sign of life while something is done whose length is not known beforehand.
    pub fn of_unknown(message: &str) -> Self {
        Progress::new(None, UNKNOWN, message)
    }

    fn new(length: Option<u64>, template: &str, message: &str) -> Self {
        let bar = ProgressBar::with_draw_target(length, ProgressDrawTarget::hidden())
            .with_style(ProgressStyle::with_template(template).expect("the template is valid"))
            .with_message(message.to_owned());
        let reveal = match (is_quiet(), io::stderr().is_terminal()) {
            (true, _) => None,
            (false, true) => Some(Reveal::bar(bar.clone())),
            (false, false) => Some(Reveal::lines(bar.clone())),
        };
        Progress { bar, reveal }
    }
}

impl Watch for Progress {
    fn finished(&self, cells: u64) {
        self.bar.inc(cells);
    }

    fn cancelled(&self) -> bool {
        interrupt::requested()
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(reveal) = self.reveal.take() {
            reveal.stop();
        }
        self.bar.finish_and_clear();
    }
}

/// Waits beside the computation to show how far it is.
#[derive(Debug)]
struct Reveal {
    done: Sender<()>,
    thread: JoinHandle<()>,
}

impl Reveal {
    fn bar(bar: ProgressBar) -> Self {
        let (done, wait) = mpsc::channel::<()>();
        let thread = thread::spawn(move || {
            if wait.recv_timeout(DELAY) == Err(RecvTimeoutError::Timeout) {
                bar.set_draw_target(ProgressDrawTarget::stderr());
                bar.enable_steady_tick(REDRAW);
            }
        });
        Reveal { done, thread }
    }

    fn lines(bar: ProgressBar) -> Self {
        let (done, wait) = mpsc::channel::<()>();
        let began = Instant::now();
        let thread = thread::spawn(move || {
            let mut silence = FIRST_LINE;
            while wait.recv_timeout(silence) == Err(RecvTimeoutError::Timeout) {
                complain(&line(&bar.message(), bar.length(), bar.position(), began.elapsed()));
                silence = (2 * silence).min(LONGEST_SILENCE);
            }
        });
        Reveal { done, thread }
    }

    fn stop(self) {
        drop(self.done);
        let _ = self.thread.join();
    }
}

/// How far something is, in a line: of so many cells, or of an unknown amount.
fn line(message: &str, cells: Option<u64>, finished: u64, elapsed: Duration) -> String {
    let elapsed_words = spans::words(elapsed);
    match cells {
        Some(cells) if finished > 0 => {
            let left = elapsed.mul_f64(cells.saturating_sub(finished) as f64 / finished as f64);
            let percent = 100 * finished / cells.max(1);
            format!(
                "{message}: {percent} % of {cells} cells after {elapsed_words}, about {} left",
                spans::words(left)
            )
        }
        _ => format!("{message}: {elapsed_words}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_how_far_it_is() {
        let seconds = Duration::from_secs;
        assert_eq!(
            line("computing", Some(4000), 1000, seconds(10)),
            "computing: 25 % of 4000 cells after 10 s, about 30 s left"
        );
        assert_eq!(line("computing", Some(4000), 0, seconds(5)), "computing: 5 s");
        assert_eq!(
            line("following the trajectory", None, 0, seconds(600)),
            "following the trajectory: 10 min"
        );
    }
}
