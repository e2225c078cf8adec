//! What ends a command early, with its exit code.

use std::process::ExitCode;

use impact_atlas::backend::BackendError;
use impact_atlas::store::StoreError;
use impact_atlas::sweep::{StoredError, SweepError};
use thiserror::Error;

/// The exit code of what was interrupted.
pub const INTERRUPTED: i32 = 130;

/// Why a command did not do what was asked; everything but a check that does not hold leaves nothing written.
#[derive(Debug, Error)]
pub enum CliError {
    /// A check did not hold: exit code 1.
    #[error("the check did not hold: {0}")]
    CheckFailed(String),
    /// What was asked for is not there: exit code 1.
    #[error("{0}")]
    NotFound(String),
    /// The input is wrong: exit code 2.
    #[error("error: {0:#}")]
    Input(anyhow::Error),
    /// The machine cannot do it: exit code 3.
    #[error("error: {0:#}")]
    Machine(anyhow::Error),
    /// A mistake in the program: exit code 3.
    #[error(
        "internal error: {0}\nThis is a bug in impact-atlas; please report it with the command that you ran."
    )]
    Bug(String),
    /// Ctrl-C: exit code 130.
    #[error("interrupted")]
    Interrupted,
}

/// What a command comes to, or one of its steps.
pub type Result<T, E = CliError> = std::result::Result<T, E>;

/// Wrong input, in words as `format!` takes them.
macro_rules! wrong {
    ($($words:tt)+) => { $crate::cli::CliError::Input(anyhow::anyhow!($($words)+)) };
}
pub(super) use wrong;

impl CliError {
    /// Wrong input.
    pub fn input(error: impl Into<anyhow::Error>) -> Self {
        CliError::Input(error.into())
    }

    /// Something that this machine cannot do.
    pub fn machine(error: impl Into<anyhow::Error>) -> Self {
        CliError::Machine(error.into())
    }

    /// What the process ends with.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            CliError::CheckFailed(_) | CliError::NotFound(_) => 1,
            CliError::Input(_) => 2,
            CliError::Machine(_) | CliError::Bug(_) => 3,
            CliError::Interrupted => INTERRUPTED as u8,
        })
    }
}

impl From<BackendError> for CliError {
    fn from(error: BackendError) -> Self {
        match error {
            BackendError::Cancelled => CliError::Interrupted,
            BackendError::Schedule(error) => CliError::input(error),
            BackendError::ControlSchedule(error) => CliError::input(error),
            error => CliError::machine(error),
        }
    }
}

impl From<SweepError> for CliError {
    fn from(error: SweepError) -> Self {
        match error {
            SweepError::Backend(error @ BackendError::Unsupported(_)) => CliError::input(error),
            SweepError::Backend(error) => error.into(),
            SweepError::Memory(_) => CliError::machine(error),
            SweepError::Plane(_)
            | SweepError::Diagram(_)
            | SweepError::System(_)
            | SweepError::Control(_) => CliError::input(error),
        }
    }
}

impl From<StoreError> for CliError {
    fn from(error: StoreError) -> Self {
        if error.is_input() { CliError::input(error) } else { CliError::machine(error) }
    }
}

impl From<StoredError> for CliError {
    fn from(error: StoredError) -> Self {
        match error {
            StoredError::Sweep(error) => error.into(),
            StoredError::Store(error) => error.into(),
        }
    }
}
