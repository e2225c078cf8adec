//! What computes.

use clap::Args;
use impact_atlas::backend::{self, Backend, BackendError, Choice, REPRODUCIBLE};
use impact_atlas::plane::Provenance;

use crate::cli::{Result, note, wrong};

/// What computes.
#[derive(Clone, Debug, Args)]
pub struct BackendArgs {
    /// What computes: the GPU (f32) or the CPU (f64)
    ///
    /// `auto` takes a hardware GPU where there is one, or the adapter that --adapter names, and otherwise the CPU: a
    /// software adapter is slower on the same cores.
    #[arg(long, value_enum, default_value_t = Choice::Auto)]
    pub backend: Choice,

    /// Uses the adapter of an address on the PCI bus or an index, or one whose name contains TEXT (see `impact-atlas adapters`)
    #[arg(long, value_name = "PCI|#INDEX|TEXT")]
    pub adapter: Option<String>,

    /// Gives the same bits on every adapter and on the CPU
    ///
    /// In f32 everywhere, every operation rounded correctly and in the order of the source, which takes two to four times as
    /// long on a software adapter, and less than f64 on a CPU with AVX2. `validate --reproducible` holds an adapter to it.
    #[arg(long)]
    pub reproducible: bool,
}

impl BackendArgs {
    /// The same options, or where none was given those of what computed a plane before.
    pub fn or_those_of(&self, provenance: &Provenance) -> Self {
        if self.backend != Choice::Auto || self.adapter.is_some() || self.reproducible {
            return self.clone();
        }
        let backend = if provenance.backend == "gpu" { Choice::Gpu } else { Choice::Cpu };
        BackendArgs { backend, adapter: None, reproducible: provenance.adapter.ends_with(REPRODUCIBLE) }
    }

    /// Opens the back end anew, after it failed, without a message.
    pub fn reopen(&self) -> Result<Box<dyn Backend>, BackendError> {
        let open = if self.reproducible { backend::open_reproducible } else { backend::open };
        open(self.backend, self.adapter.as_deref())
    }

    /// Opens the back end and says which one it is.
    pub fn open(&self) -> Result<Box<dyn Backend>> {
        if let (Choice::Cpu, Some(adapter)) = (self.backend, &self.adapter) {
            return Err(wrong!(
                "--adapter {adapter} chooses an adapter of the GPU back end: drop it or --backend cpu"
            ));
        }
        let backend = self.reopen()?;
        let fallback = self.backend == Choice::Auto && backend.name() == "cpu";
        let why = if fallback { "; no hardware GPU was found" } else { "" };
        note(&format!("computing on {}: {}{why}", backend.name(), backend.adapter()));
        Ok(backend)
    }
}
