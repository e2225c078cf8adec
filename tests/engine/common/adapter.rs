//! The adapter that tests run on: the best hardware adapter, or a software one. That there is none is a failure.

use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use impact_atlas::backend::{Backend, BackendError, Gpu};

/// A device of one's own: while it compiles a shader, nothing runs on it.
pub fn open() -> Gpu {
    told(Gpu::open(None))
}

/// The same with exact arithmetic.
pub fn open_exact() -> Gpu {
    told(Gpu::open_exact(None))
}

fn told(opened: Result<Gpu, BackendError>) -> Gpu {
    let gpu = opened.expect("an adapter is there; a software one will do");
    println!("adapter: {}", gpu.adapter());
    gpu
}

/// The device of most suites, so that a shader is compiled once.
pub fn gpu() -> &'static Gpu {
    static GPU: LazyLock<Gpu> = LazyLock::new(open);
    &GPU
}

/// Works on everything that is given, on two devices at a time, since a device compiles one shader after the other.
pub fn on_devices<T: Sync>(devices: [&Gpu; 2], items: &[T], work: impl Fn(&Gpu, &T) + Sync) {
    let next = AtomicUsize::new(0);
    let turn = |device| {
        while let Some(item) = items.get(next.fetch_add(1, Ordering::Relaxed)) {
            work(device, item);
        }
    };
    std::thread::scope(|scope| devices.map(|device| scope.spawn(|| turn(device))).map(drop));
}
