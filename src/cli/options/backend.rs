//! What computes.

use anyhow::anyhow;
use clap::{Args, ValueEnum};
use impact_atlas::backend::{self, Backend, BackendError, Choice, REPRODUCIBLE};
use impact_atlas::plane::Provenance;

use crate::cli::{CliError, note};

/// What computes.
#[derive(Clone, Debug, Args)]
pub struct BackendArgs {
    /// What computes: the GPU (f32) or the CPU (f64)
    ///
    /// `auto` takes a hardware GPU where there is one, or the adapter that --adapter names, and otherwise the CPU: a
    /// software adapter is slower on the same cores.
    #[arg(long, value_enum, default_value_t = BackendName::Auto)]
    pub backend: BackendName,

    /// Uses the adapter of an address on the PCI bus or an index, or one whose name contains TEXT (see `impact-atlas adapters`)
    #[arg(long, value_name = "PCI|#INDEX|TEXT")]
    pub adapter: Option<String>,

    /// Gives the same bits on every adapter and on the CPU
    ///
    /// In f32 everywhere, every operation rounded correctly and in the order of the source, which takes two to four times as
    /// long on a software adapter. `validate --reproducible` holds an adapter to it.
    #[arg(long)]
    pub reproducible: bool,
}

/// A back end by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BackendName {
    /// A hardware GPU, otherwise the CPU
    Auto,
    /// A hardware GPU, otherwise a software adapter
    Gpu,
    /// Double precision on all cores; the reference
    Cpu,
}

impl BackendArgs {
    /// The same options, or where none was given those of what computed a plane before.
    pub fn or_those_of(&self, provenance: &Provenance) -> Self {
        if self.backend != BackendName::Auto || self.adapter.is_some() || self.reproducible {
            return self.clone();
        }
        let backend = if provenance.backend == "gpu" { BackendName::Gpu } else { BackendName::Cpu };
        BackendArgs { backend, adapter: None, reproducible: provenance.adapter.ends_with(REPRODUCIBLE) }
    }

    /// Opens the back end anew, after it failed, without a message.
    pub fn reopen(&self) -> Result<Box<dyn Backend>, BackendError> {
        let open = if self.reproducible { backend::open_reproducible } else { backend::open };
        open(self.choice(), self.adapter.as_deref())
    }

    fn choice(&self) -> Choice {
        match self.backend {
            BackendName::Auto => Choice::Auto,
            BackendName::Gpu => Choice::Gpu,
            BackendName::Cpu => Choice::Cpu,
        }
    }

    /// Opens the back end and says which one it is.
    pub fn open(&self) -> Result<Box<dyn Backend>, CliError> {
        if let (BackendName::Cpu, Some(adapter)) = (self.backend, &self.adapter) {
            return Err(CliError::Input(anyhow!(
                "--adapter {adapter} chooses an adapter of the GPU back end: drop it or --backend cpu"
            )));
        }
        let backend = self.reopen()?;
        let fallback = self.backend == BackendName::Auto && backend.name() == "cpu";
        let why = if fallback { "; no hardware GPU was found" } else { "" };
        note(&format!("computing on {}: {}{why}", backend.name(), backend.adapter()));
        Ok(backend)
    }
}
