//! Progress with the time left, for what takes longer than a second, on a terminal.

use std::io::{self, IsTerminal};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use impact_atlas::backend::Watch;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::interrupt;

/// What is done sooner shows no bar.
const DELAY: Duration = Duration::from_secs(1);

const REDRAW: Duration = Duration::from_millis(250);

const CELLS: &str = "{msg} {bar:30} {percent:>3} % of {human_len} cells, {eta} left";

/// A single trajectory may settle at any time, so that nobody knows how long it takes.
const TRAJECTORY: &str = "{spinner} following the trajectory, {elapsed}";

const FIGURE: &str = "{spinner} {msg}, {elapsed}";

/// Nobody knows how long the curves are.
const CURVES: &str = "{spinner} following the bifurcation curves, {elapsed}";

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
        Progress::new(None, TRAJECTORY, "")
    }

    /// A sign of life while figure after figure is made.
    pub fn of_figure(message: &str) -> Self {
        Progress::new(None, FIGURE, message)
    }

    /// A sign of life while bifurcation curves are followed.
    pub fn of_curves() -> Self {
        Progress::new(None, CURVES, "")
    }

    fn new(length: Option<u64>, template: &str, message: &str) -> Self {
        let bar = ProgressBar::with_draw_target(length, ProgressDrawTarget::hidden())
            .with_style(ProgressStyle::with_template(template).expect("the template is valid"))
            .with_message(message.to_owned());
        let reveal = io::stderr().is_terminal().then(|| Reveal::start(bar.clone()));
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

/// Waits beside the computation to show the bar.
#[derive(Debug)]
struct Reveal {
    done: Sender<()>,
    thread: JoinHandle<()>,
}

impl Reveal {
    fn start(bar: ProgressBar) -> Self {
        let (done, wait) = mpsc::channel::<()>();
        let thread = thread::spawn(move || {
            if wait.recv_timeout(DELAY) == Err(RecvTimeoutError::Timeout) {
                bar.set_draw_target(ProgressDrawTarget::stderr());
                bar.enable_steady_tick(REDRAW);
            }
        });
        Reveal { done, thread }
    }

    fn stop(self) {
        drop(self.done);
        let _ = self.thread.join();
    }
}
