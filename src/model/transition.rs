//! Free flight over any time.

use nalgebra::{DMatrix, Matrix2};

use super::free_flight::{FreeFlight, inverse_mass};
use super::real::Lanes;
use super::step::{Columns, Step};
use super::width::{AtWidth, Width};
use crate::system::{Plant, sized};

/// rate·h of the step that is doubled is kept below this: its series grows little before it falls, and few doublings lose little.
const SHORT: f64 = 2.0;

/// Calls a generic function for as many coordinates: those of a plant, or one more where a force is one of them.
macro_rules! of_coordinates {
    ($n:expr, $of:ident($($argument:expr),*)) => {
        sized!($n, N of 1 2 3 4 5: $of::<N>($($argument),*), else unreachable!("no plant has {} coordinates", $n))
    };
}

/// G of a plant, (2n + 3) × (2n + 3): between impacts z' = G z with z = (x, v, sin φ, cos φ, 1); everything is non-dimensional.
pub(crate) fn generator(plant: &Plant) -> DMatrix<f64> {
    fn of<const N: usize>(plant: &Plant) -> DMatrix<f64> {
        FreeFlight::<N>::of(plant, &inverse_mass(plant)).generator()
    }
    of_coordinates!(plant.n, of(plant))
}

/// exp(G t), what free flight over a time makes of z = (x, v, sin φ, cos φ, 1): (2n + 3) × (2n + 3), of the same size as G. The rate
/// is that of [`System::rate`](super::System::rate); everything is non-dimensional.
///
/// Nothing of it is a number where the time is none, or infinite.
///
/// A general matrix exponential knows neither the rows of sin φ and cos φ beforehand nor the rate, and takes several times as long.
pub(crate) fn transition(generator: &DMatrix<f64>, rate: f64, time: f64) -> DMatrix<f64> {
    if !time.is_finite() {
        return DMatrix::from_element(generator.nrows(), generator.ncols(), f64::NAN);
    }
    of_coordinates!((generator.nrows() - 3) / 2, over(generator, rate, time))
}

/// The same of N coordinates.
fn over<const N: usize>(generator: &DMatrix<f64>, rate: f64, time: f64) -> DMatrix<f64> {
    let free = FreeFlight::<N>::of_generator(generator);
    let mut step = Width::widest().compute(Doubled { free: &free, rate, time });
    let mut over = DMatrix::identity(generator.nrows(), generator.ncols());
    for i in 0..2 * N + 3 {
        for (place, value) in over.column_mut(i).iter_mut().zip(step.column(i).values()) {
            *place = value;
        }
    }
    let (sin, cos) = libm::sincos(free.omega * time);
    over.view_mut((2 * N, 2 * N), (2, 2)).copy_from(&Matrix2::new(cos, sin, -sin, cos));
    over
}

/// A step of any length: a short one, doubled as often as it takes.
#[derive(Clone, Copy)]
struct Doubled<'a, const N: usize> {
    free: &'a FreeFlight<N>,
    rate: f64,
    time: f64,
}

impl<const N: usize> AtWidth<f64> for Doubled<'_, N> {
    type Output = Step<f64, N>;
    const PAIRED: bool = Columns::<N>::PAIRED;

    #[inline(always)]
    fn call<L: Lanes<Real = f64>>(self, zero: L) -> Step<f64, N> {
        let Doubled { free, rate, time } = self;
        let (mut h, mut doublings) = (time, 0);
        while rate * h.abs() > SHORT {
            h *= 0.5;
            doublings += 1;
        }
        let mut step = Columns { free, h }.call(zero);
        for _ in 0..doublings {
            step = step.doubled(libm::sincos(free.omega * h));
            h *= 2.0;
        }
        step
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::equations::Equations;
    use crate::model::example::{coupled, for_every_size};
    use crate::model::width::at_every_width;

    fn away(one: &DMatrix<f64>, other: &DMatrix<f64>) -> f64 {
        (one - other).amax() / (1.0 + other.amax())
    }

    fn is_the_exponential<const N: usize>() {
        let free = coupled::<N>();
        for equations in [free, free.held_along(0)] {
            let (generator, rate) = (equations.generator(), equations.rate());
            for time in [0.0, 1e-9, 0.03, 0.7, 1.9, 4.0, 11.0, -0.4, -2.5] {
                let found = transition(&generator, rate, time);
                let exact = (&generator * time).exp();
                assert!(away(&found, &exact) < 2e-14, "{N}, {time}: {}", away(&found, &exact));
                let other = (&generator * (1.01 * time + 1e-6)).exp();
                assert!(away(&found, &other) > 1e-8, "the check can fail");
            }
        }
    }

    #[test]
    fn it_is_the_exponential_of_the_generator() {
        for_every_size!(is_the_exponential);
    }

    fn joins<const N: usize>() {
        let equations = coupled::<N>();
        let over = |time: f64| transition(&equations.generator(), equations.rate(), time);
        for (one, other) in [(0.3, 0.4), (3.7, 1.1), (8.0, -7.5), (2.0, -2.0)] {
            let apart = away(&(over(other) * over(one)), &over(one + other));
            assert!(apart < 1e-12, "{N}, {one} and {other}: {apart}");
            assert!(away(&over(one), &over(one + other)) > 1e-2, "the check can fail");
        }
    }

    #[test]
    fn flight_after_flight_is_flight_over_both_times() {
        for_every_size!(joins);
    }

    fn is_the_same_at_every_width<const N: usize>() {
        let free: Equations<N> = coupled();
        let bits = |mut step: Step<f64, N>| {
            (0..2 * N + 3)
                .flat_map(|i| step.column(i).values().map(f64::to_bits).collect::<Vec<_>>())
                .collect::<Vec<_>>()
        };
        let doubled = |time: f64| Doubled { free: &free, rate: free.rate(), time };
        let own = bits(Width::One.compute(doubled(7.3)));
        assert!(at_every_width(doubled(7.3)).into_iter().all(|step| bits(step) == own), "{N} coordinates");
        assert_ne!(bits(Width::One.compute(doubled(7.4))), own, "the check can fail");
    }

    #[test]
    fn it_is_the_same_to_the_bit_at_every_width() {
        for_every_size!(is_the_same_at_every_width);
    }

    #[test]
    fn a_system_without_damping_at_its_resonance_is_no_special_case() {
        // x″ + x = sin t from rest: x = (sin t − t cos t)/2, what becomes of cos φ = 1.
        let mut equations = coupled::<1>();
        let free = &mut equations.free;
        (free.stiffness[0], free.damping[0], free.omega) = (-1.0, 0.0, 1.0);
        (free.sin[0], free.cos[0], free.load[0]) = (1.0, 0.0, 0.0);
        let (generator, rate) = (equations.generator(), equations.rate());
        for time in [0.5, 3.0, 40.0] {
            let over = transition(&generator, rate, time);
            let exact = 0.5 * (time.sin() - time * time.cos());
            assert!((over[(0, 3)] - exact).abs() < 1e-14 * (1.0 + time * time), "{time}: {}", over[(0, 3)]);
        }
    }

    #[test]
    fn no_time_leads_anywhere_where_it_is_no_number() {
        let equations = coupled::<2>();
        for time in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let over = transition(&equations.generator(), equations.rate(), time);
            assert!(over.iter().all(|value| value.is_nan()));
        }
        // A time that Newton's method may try for a moment is followed all the same.
        let over = transition(&equations.generator(), equations.rate(), 1e300);
        assert_eq!(over.shape(), (7, 7));
    }
}
