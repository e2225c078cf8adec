//! The back end as others use it, on the software adapter where there is no other.

use super::*;
use crate::analysis::{Reading, Section};
use crate::backend::Unwatched;
use crate::model::{Flows, Setting, StateVector};
use crate::plane::Start;
use crate::system::Family;

/// Cells of few flows that go through chatter, sticking, chaos and rest.
fn jobs() -> Vec<Job> {
    let flows = Flows::default();
    let cell = |omega: f64, delta: f64| {
        let setting = Setting::defaults(Family::paper()).with_named("omega", omega);
        let system = flows.share(System::new(setting.with_named("delta", delta)).unwrap());
        let start = Start::Symmetric.state(&system);
        Job { system, start }
    };
    [0.3, 0.9, 1.5, 2.6, 3.7]
        .into_iter()
        .flat_map(|omega| [0.03, 0.11, 0.22, 0.5].map(|delta| cell(omega, delta)))
        .collect()
}

/// Cells of which each has a flow of its own take more room than those that share theirs.
#[test]
fn what_a_device_cannot_bind_at_once_is_followed_in_batches() {
    let schedule = Schedule { transient: 20, observe: 20, max_period: 8, fixed_periods: true };
    let job = |omega: f64| {
        let system = System::new(Setting::defaults(Family::paper()).with_named("omega", omega)).unwrap();
        Job { system, start: [0.0; 4].into() }
    };
    let jobs: Vec<Job> = (0..60).map(|i| job(1.0 + 0.05 * f64::from(i))).collect();
    let found = adapters::find(None).expect("an adapter");
    println!("{}", found.report);
    let arithmetic = Arithmetic::Native;
    let limits = wgpu::Limits { max_storage_buffer_binding_size: 16 << 10, ..wgpu::Limits::default() };
    let kernel = Kernel::within(limits, &found, arithmetic).unwrap();
    let expected: Vec<Verdict> =
        jobs.chunks(7).flat_map(|some| kernel.run(Batch::of(some), &schedule, &Unwatched).unwrap()).collect();
    let batches = |jobs: &[Job]| -> Vec<usize> {
        let tiles = kernel.tiles(shader::Kernel::Follow, jobs, 0).unwrap();
        let batches = tiles.iter().flat_map(|tile| kernel.batches(shader::Kernel::Follow, tile).unwrap());
        batches.map(|batch| batch.jobs.len()).collect()
    };
    let of_own_flows = batches(&jobs);
    assert!(of_own_flows.len() > 2 && of_own_flows[0] > 7, "{of_own_flows:?}");
    assert_eq!(of_own_flows.iter().sum::<usize>(), jobs.len());
    let of_one_flow = batches(&vec![jobs[0].clone(); 60]);
    assert!(of_one_flow.len() < of_own_flows.len(), "{of_one_flow:?}");
    let at_once = kernel.run(Batch::of(&jobs), &schedule, &Unwatched);
    assert!(matches!(at_once, Err(BackendError::Device(_))), "too many for one batch");
    let gpu = Gpu { report: found.report, arithmetic, kernel };
    let verdicts = gpu.run(&jobs, &schedule, &Unwatched).unwrap();
    assert_eq!(format!("{verdicts:?}"), format!("{expected:?}"));
    assert!(verdicts.iter().any(|verdict| verdict.state != verdicts[0].state), "not all are alike");
}

/// Gives up at once.
struct GivenUp;

impl Watch for GivenUp {
    fn cancelled(&self) -> bool {
        true
    }
}

/// Buffers of a tile that is done are another's, which may be smaller.
#[test]
fn what_one_tile_left_is_nothing_to_the_next() {
    let schedule = Schedule { transient: 20, observe: 20, max_period: 8, fixed_periods: true };
    let open = || {
        let gpu = Gpu::open(None).expect("an adapter");
        println!("{}", gpu.report);
        gpu
    };
    let ways = |gpu: &Gpu, jobs: &[Job]| {
        let probe = Probe { section: Section::A, reading: Reading::VAfter };
        let verdicts = gpu.run(jobs, &schedule, &Unwatched).unwrap();
        let traces = gpu.trace(jobs, &schedule, probe, 64, &Unwatched).unwrap();
        let extents = gpu.extents(jobs, &vec![20; jobs.len()], &Unwatched).unwrap();
        format!("{verdicts:?} {traces:?} {extents:?}")
    };
    let (used, jobs) = (open(), jobs());
    let before = ways(&used, &jobs);
    let kept = used.kernel.kept();
    assert!(kept > 3, "{kept} buffers are kept");
    // Another shape, and what is given up on the way.
    let ball = System::new(Setting::defaults(Family::builtin("shaw-holmes"))).unwrap();
    ways(&used, &[Job { system: ball, start: StateVector::zeros(1) }]);
    assert!(matches!(used.run(&jobs, &schedule, &GivenUp), Err(BackendError::Cancelled)));
    assert!(used.kernel.kept() <= kept + 2, "{} buffers are kept", used.kernel.kept());
    let fewer = &jobs[7..12];
    let found = ways(&used, fewer);
    assert_eq!(found, ways(&open(), fewer));
    assert_eq!(before, ways(&used, &jobs));
    assert_ne!(found, ways(&used, &jobs[6..11]), "the check can fail");
}

/// What hardware compiles is run by the software adapter too, with the same bits as what that compiles.
#[test]
fn hardwares_shader_gives_the_bits_of_the_software_adapters() {
    let schedule = Schedule { transient: 40, observe: 40, max_period: 8, fixed_periods: false };
    let jobs = jobs();
    // With too little memory of the workgroup it is the software adapter's.
    let kernel = |of_workgroups: u32| {
        let found = adapters::find(None).expect("an adapter");
        println!("{}", found.report);
        let limits =
            wgpu::Limits { max_compute_workgroup_storage_size: of_workgroups, ..wgpu::Limits::default() };
        Kernel::within(limits, &found, Arithmetic::Exact).unwrap().with_shaders_of_hardware(Arithmetic::Exact)
    };
    let run = |kernel: &Kernel, jobs: &[Job]| {
        format!("{:?}", kernel.run(Batch::of(jobs), &schedule, &Unwatched).unwrap())
    };
    let (hardwares, softwares) = (kernel(16 << 10), kernel(1 << 10));
    // At the same time, since it is the compiler that takes long.
    let (found, expected) = rayon::join(|| run(&hardwares, &jobs), || run(&softwares, &jobs));
    assert_eq!(found, expected);
    for met in ["regime: Periodic,", "regime: PeriodicSticking", "regime: Chaotic", "symmetric: true"] {
        assert!(expected.contains(met), "{met}: {expected}");
    }
    // The test can fail: a cell with another gap comes to something else.
    let mut other = jobs.clone();
    other[5] = jobs[6].clone();
    assert_ne!(run(&hardwares, &other), expected);
}
