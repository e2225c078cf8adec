//! Exact quotients and roots on a device, from a driver's that are a few units in the last place off.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use wgpu::util::DeviceExt;

use super::Kernel;
use super::device::{compiled, empty};
use crate::backend::gpu::shader::{Arithmetic, exact};

/// A pair of numbers, and by how many units the driver's quotient and root are off.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Pair {
    a: f32,
    b: f32,
    off: i32,
}

const MAIN: &str = "
struct Dispatch { begin: u32 }
struct Pair { a: f32, b: f32, off: i32 }
@group(0) @binding(0) var<uniform> dispatch: Dispatch;
@group(0) @binding(1) var<storage, read> pairs: array<Pair>;
@group(0) @binding(2) var<storage, read_write> results: array<vec2<f32>>;
var<private> off: i32;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&pairs) {
        return;
    }
    let pair = pairs[id.x];
    off = pair.off;
    results[id.x] = vec2<f32>(pair.a / pair.b, sqrt(abs(pair.a)));
}
";

/// What the functions begin with, and the same some units off.
const NEAR: [(&str, &str); 2] = [
    ("let near = dividend / divisor;", "let near = exact_neighbour(dividend / divisor, off);"),
    ("let near = sqrt(square);", "let near = exact_neighbour(sqrt(square), off);"),
];

/// The quotients and roots of a device whose own are off by what the pairs say.
fn computed(pairs: &[Pair], source: &str) -> Vec<[f32; 2]> {
    let kernel = Kernel::on_any_adapter(Arithmetic::Exact);
    let module = exact(source).unwrap();
    let module = wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(module));
    let pipeline = compiled(&kernel.device, "main", module).unwrap();
    let filled = |contents: &[u8], usage| {
        let descriptor = wgpu::util::BufferInitDescriptor { label: None, contents, usage };
        kernel.device.create_buffer_init(&descriptor)
    };
    let dispatch = filled(&1u32.to_le_bytes(), wgpu::BufferUsages::UNIFORM);
    let given = filled(bytemuck::cast_slice(pairs), wgpu::BufferUsages::STORAGE);
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    let results = empty(&kernel.device, 8 * pairs.len() as u64, usage);
    let entries = [(0, &dispatch), (1, &given), (2, &results)]
        .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() });
    let bound = kernel.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    let mut encoder = kernel.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &bound, &[]);
    pass.dispatch_workgroups(pairs.len().div_ceil(64) as u32, 1, 1);
    drop(pass);
    kernel.queue.submit([encoder.finish()]);
    kernel.read(&results, results.size(), <[_]>::to_vec).unwrap()
}

/// Random numbers, and those whose quotients and roots lie near powers of two or near the middle between two numbers.
fn pairs() -> Vec<Pair> {
    let mut rng = ChaCha8Rng::seed_from_u64(0x01AC_7A71_A500_0051);
    (0..1_000_000)
        .map(|i| {
            let mut mantissa = || f32::from_bits(0x3f80_0000 | (rng.random::<u32>() & 0x007f_ffff));
            let (mut a, mut b) = (mantissa(), mantissa());
            match i % 4 {
                0 => {}
                // A quotient beside 1, or a root beside a power of two.
                1 => (a, b) = (f32::from_bits(b.to_bits() - 1 + i / 4 % 3), b),
                2 => a = f32::from_bits(0x3f80_0000 - 4 + i / 4 % 9),
                // A divisor beside a power of two.
                _ => b = f32::from_bits(0x3f80_0000 - 4 + i / 4 % 9),
            }
            let sign = if rng.random() { 1.0 } else { -1.0 };
            // Of order one, and as small as the squares of micrometres.
            let least = if i % 3 == 0 { -100 } else { -30 };
            let mut scale = || 2.0_f32.powi(rng.random_range(least..30));
            let (a, b) = (sign * a * scale(), b * scale());
            Pair { a, b, off: rng.random_range(-3..=3) }
        })
        .collect()
}

/// How many quotients and roots are not those of IEEE 754; quotients that overflow or underflow, or nearly, are the driver's.
fn wrong(pairs: &[Pair], results: &[[f32; 2]]) -> [usize; 2] {
    let is_wrong = |k: usize, (pair, result): (&Pair, &[f32; 2])| {
        let right = [pair.a / pair.b, pair.a.abs().sqrt()];
        let ordinary = (1.1e-34..0.9e34).contains(&right[k].abs());
        ordinary && result[k].to_bits() != right[k].to_bits()
    };
    [0, 1].map(|k| pairs.iter().zip(results).filter(|&both| is_wrong(k, both)).count())
}

#[test]
fn quotients_and_roots_that_are_off_are_corrected_to_the_nearest_number() {
    let pairs = pairs();
    let plain = [Arithmetic::Exact.source(), MAIN].concat();
    let off = NEAR.iter().fold(plain.clone(), |source, (near, off)| {
        assert!(source.contains(near));
        source.replace(near, off)
    });
    assert_eq!(wrong(&pairs, &computed(&pairs, &plain)), [0, 0]);
    assert_eq!(wrong(&pairs, &computed(&pairs, &off)), [0, 0]);
    // The negative control: without the corrections what is off stays off.
    let left = off.replace("if !exact_is_ordinary(dividend)", "if true || !exact_is_ordinary(dividend)");
    let left = left.replace("if !exact_is_ordinary(square)", "if true || !exact_is_ordinary(square)");
    let [quotients, roots] = wrong(&pairs, &computed(&pairs, &left));
    assert!(quotients > pairs.len() / 2 && roots > pairs.len() / 2, "{quotients}, {roots}");
}
