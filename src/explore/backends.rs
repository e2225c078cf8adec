//! The back ends that pages may choose, each opened once.

use std::sync::LazyLock;

use parking_lot::Mutex;
use serde::Serialize;

use crate::backend::{self, AdapterReport, Backend, BackendError, Choice};

/// A back end that is open for as long as the program runs.
#[derive(Clone, Copy, Debug)]
pub struct Computing {
    /// What was asked for.
    pub asked: Asked,
    /// The back end.
    pub backend: &'static dyn Backend,
}

/// What a page asks for: automatic, the CPU, a GPU, or one of the adapters by its number in the list of adapters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// A hardware GPU where there is one, the CPU path elsewhere.
    Auto,
    /// The CPU path.
    Cpu,
    /// A hardware GPU, else a software adapter.
    Gpu,
    /// An adapter.
    Adapter(usize),
}

impl Asked {
    /// What a page says: "auto", "cpu", "gpu", or "adapter:" and a number.
    pub fn read(text: &str) -> Option<Asked> {
        match text {
            "auto" => Some(Asked::Auto),
            "cpu" => Some(Asked::Cpu),
            "gpu" => Some(Asked::Gpu),
            text => {
                let number: usize = text.strip_prefix("adapter:")?.parse().ok()?;
                (number < adapters().len()).then_some(Asked::Adapter(number))
            }
        }
    }

    /// The adapter whose description contains a text.
    ///
    /// # Errors
    /// [`BackendError::NoAdapter`] where there is none.
    pub fn adapter(text: &str) -> Result<Asked, BackendError> {
        let wanted = text.to_lowercase();
        let found =
            adapters().iter().position(|adapter| adapter.to_string().to_lowercase().contains(&wanted));
        let none =
            || BackendError::NoAdapter(format!("no adapter matches `{text}`: see `impact-atlas adapters`"));
        found.map(Asked::Adapter).ok_or_else(none)
    }

    /// What a page says to ask for it.
    pub fn name(self) -> String {
        match self {
            Asked::Auto => "auto".into(),
            Asked::Cpu => "cpu".into(),
            Asked::Gpu => "gpu".into(),
            Asked::Adapter(number) => format!("adapter:{number}"),
        }
    }

    /// The options of the command line that ask for it.
    pub fn options(self) -> Vec<String> {
        let texts: &[&str] = match self {
            Asked::Auto => &[],
            Asked::Cpu => &["--backend", "cpu"],
            Asked::Gpu => &["--backend", "gpu"],
            Asked::Adapter(number) => return vec!["--adapter".into(), adapters()[number].name.clone()],
        };
        texts.iter().map(|&text| text.into()).collect()
    }
}

/// The adapters of this machine, looked for once.
pub fn adapters() -> &'static [AdapterReport] {
    static ADAPTERS: LazyLock<Vec<AdapterReport>> = LazyLock::new(backend::adapters);
    &ADAPTERS
}

/// A back end in a list to choose from.
#[derive(Clone, Debug, Serialize)]
pub struct Choosable {
    /// What is sent to ask for it.
    pub name: String,
    /// What it is, in words.
    pub about: String,
}

/// Everything that can be chosen.
pub fn choosable() -> Vec<Choosable> {
    let fixed = [
        (Asked::Auto, "automatic: a hardware GPU if there is one".to_owned()),
        (Asked::Cpu, "CPU, double precision".to_owned()),
    ];
    let named = adapters().iter().enumerate().map(|(number, adapter)| {
        (Asked::Adapter(number), format!("{} ({}), single precision", adapter.name, adapter.kind))
    });
    fixed.into_iter().chain(named).map(|(asked, about)| Choosable { name: asked.name(), about }).collect()
}

/// The back end that is asked for, opened if it is not open yet.
///
/// # Errors
/// What the machine does not have.
pub fn open(asked: Asked) -> Result<Computing, BackendError> {
    static OPEN: Mutex<Vec<Computing>> = Mutex::new(Vec::new());
    let mut open = OPEN.lock();
    if let Some(computing) = open.iter().find(|computing| computing.asked == asked) {
        return Ok(*computing);
    }
    let (choice, adapter) = match asked {
        Asked::Auto => (Choice::Auto, None),
        Asked::Cpu => (Choice::Cpu, None),
        Asked::Gpu => (Choice::Gpu, None),
        Asked::Adapter(number) => (Choice::Gpu, adapters().get(number).map(|adapter| adapter.name.as_str())),
    };
    // There are as many as can be chosen, and they are used until the program ends.
    let backend: &'static dyn Backend = Box::leak(backend::open(choice, adapter)?);
    let computing = Computing { asked, backend };
    open.push(computing);
    Ok(computing)
}
