//! One turn of a trajectory over N forcing periods, with its derivative.

use nalgebra::{DMatrix, DVector};

use super::flow::Flow;
use super::follower::Follower;
use crate::analysis::{INFINITELY_MANY, Loss};
use crate::dynamics::{Event, Impact, Moves, Stop};

/// One turn of a trajectory over N forcing periods, with its derivative.
pub(super) struct Turn {
    pub end: DVector<f64>,
    /// The states at the forcing periods before the end.
    strobes: Vec<DVector<f64>>,
    pub jacobian: DMatrix<f64>,
    /// The state and its derivative half a turn from the start, for odd N.
    pub half: Option<(DVector<f64>, DMatrix<f64>)>,
    pub impacts: Vec<u16>,
    pub sticking: bool,
    pub peak: f64,
    /// All impacts but those that were closed.
    pub met: u32,
    /// What they took, and how long contacts held.
    pub loss: Loss<f64>,
    pub hardest: Option<Hardest>,
}

/// The hardest impact of a turn.
pub(super) struct Hardest {
    pub stop: Stop,
    speed: f64,
    pub section: Vec<f64>,
}

impl Turn {
    /// Follows a trajectory; none if its state is not finite, or it makes too many moves.
    pub fn from(follower: &mut dyn Follower, flow: &Flow, start: &DVector<f64>, n: u32) -> Option<Self> {
        follower.begin(start.as_slice());
        follower.carry();
        let clamping = follower.clamping();
        let clamped = |(stop, _)| if clamping.contains(&stop) { INFINITELY_MANY } else { 0 };
        let mut turn = Turn {
            end: start.clone(),
            strobes: Vec::new(),
            jacobian: follower.tangents(),
            half: None,
            impacts: flow.faces().enumerate().map(clamped).collect(),
            sticking: !clamping.is_empty(),
            peak: 0.0,
            met: 0,
            loss: follower.loss(),
            hardest: None,
        };
        let mut moves = Moves::default();
        for period in 0..n {
            moves.pass_period();
            turn.strobes.push(follower.state());
            loop {
                let taken = follower.next_event(&mut moves)?;
                turn.sticking |= !taken.contact.is_free();
                match taken.event {
                    Event::Impact(impact) => turn.note(follower, flow, &impact, false),
                    Event::Caught { impact, complete_chatter, beside, .. } => {
                        turn.sticking = true;
                        if impact.velocity_before != 0.0 {
                            turn.note(follower, flow, &impact, complete_chatter);
                        }
                        for stop in follower.stops_of(beside) {
                            turn.impacts[stop.index()] = INFINITELY_MANY;
                        }
                    }
                    Event::HalfPeriod if n % 2 == 1 && period == n / 2 => {
                        turn.half = Some((follower.state(), follower.tangents()));
                    }
                    Event::Strobe => break,
                    _ => {}
                }
            }
        }
        turn.end = follower.state();
        turn.jacobian = follower.tangents();
        turn.loss = follower.loss();
        Some(turn)
    }

    /// The smallest divisor of n after which the state is the same already.
    pub fn shorter(&self, n: u32, tolerance: f64) -> Option<u32> {
        let same = |m: &u32| (&self.strobes[*m as usize] - &self.strobes[0]).amax() <= tolerance;
        (1..n).filter(|m| n.is_multiple_of(*m)).find(same)
    }

    /// Counts an impact, and keeps it if it is the hardest so far; those at an earlier stop count before all others.
    fn note(&mut self, follower: &dyn Follower, flow: &Flow, impact: &Impact<f64>, complete_chatter: bool) {
        let stop = impact.stop;
        let count = &mut self.impacts[stop.index()];
        if complete_chatter {
            *count = INFINITELY_MANY;
        } else if *count < INFINITELY_MANY - 1 {
            *count += 1;
        }
        self.met += 1;
        self.peak = self.peak.max(impact.velocity_before.abs());
        let speed = impact.velocity_after.abs();
        let harder = self
            .hardest
            .as_ref()
            .is_none_or(|hardest| stop < hardest.stop || (stop == hardest.stop && speed > hardest.speed));
        if harder {
            let phase = follower.phase(flow.omega);
            let section = flow.face(stop).section(follower.x(), follower.v(), phase);
            let section = section.iter().map(|value| value + 0.0).collect();
            self.hardest = Some(Hardest { stop, speed, section });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Contact;
    use crate::model::System;
    use crate::system::{Plant, PlantStop};
    use crate::theory::example::{Ball, chain};
    use crate::theory::follower::follower;

    fn turned(system: &System, start: &DVector<f64>, n: u32) -> Turn {
        Turn::from(follower(system).as_mut(), &Flow::new(system), start, n).unwrap()
    }

    #[test]
    fn a_turn_of_the_bouncing_ball_closes_on_itself() {
        let ball = Ball::STABLE;
        let section = ball.section(false).unwrap();
        let state = ball.state(section);
        let start = DVector::from_row_slice(&state);
        let system = ball.system();
        let turn = turned(&system, &start, 1);
        assert!((&turn.end - &start).amax() < 1e-12, "{} for {start}", turn.end);
        assert_eq!((&turn.impacts[..], turn.sticking), (&[1][..], false));
        // v− = g T/(1 + r).
        let arrives = ball.load * std::f64::consts::TAU / (1.0 + ball.restitution);
        assert!((turn.peak - arrives).abs() < 1e-12, "{}", turn.peak);
        let hardest = turn.hardest.as_ref().unwrap();
        let away = hardest.section.iter().zip(section).map(|(found, expected)| (found - expected).abs());
        assert!(hardest.stop == Stop::A && away.fold(0.0, f64::max) < 1e-12, "{:?}", hardest.section);
        // The strobe map and the impact map have the same multipliers.
        let jacobian = ball.jacobian(section);
        assert!((turn.jacobian.trace() - jacobian.trace()).abs() < 1e-10);
        assert!((turn.jacobian.determinant() - jacobian.determinant()).abs() < 1e-10);
        // Three periods of it are thrice one.
        let turn = turned(&system, &start, 3);
        assert_eq!((&turn.impacts[..], turn.shorter(3, 1e-9)), (&[3][..], Some(1)));
        let astray = turned(&system, &DVector::from_row_slice(&[state[0] - 0.1, state[1]]), 3);
        assert_eq!(astray.shorter(3, 1e-9), None, "a trajectory that does not close has no period");
    }

    #[test]
    fn the_jacobian_of_a_turn_is_that_of_finite_differences() {
        let system = chain();
        let start = DVector::from_row_slice(&[0.05, -0.02, 0.03, 0.4, 0.6, -0.3]);
        let turn = turned(&system, &start, 1);
        assert!(turn.impacts.iter().sum::<u16>() > 0 && !turn.sticking, "{:?}", turn.impacts);
        let step = 1e-6;
        for column in 0..6 {
            let of = |sign: f64| {
                let mut moved = start.clone();
                moved[column] += sign * step;
                turned(&system, &moved, 1).end
            };
            let difference = (of(1.0) - of(-1.0)) / (2.0 * step);
            let away = (turn.jacobian.column(column) - &difference).amax();
            assert!(away < 1e-6 * (1.0 + difference.amax()), "{column}: {away}");
        }
        // Volumes shrink by exp(−T tr M⁻¹C) in flight and by r² in each impact.
        let impacts = i32::from(turn.impacts.iter().sum::<u16>());
        let volume = (-system.period() * system.contraction()).exp() * 0.7f64.powi(2 * impacts);
        assert!((turn.jacobian.determinant() / volume - 1.0).abs() < 1e-9, "{impacts}");
        assert!((turn.jacobian.determinant() / (0.49 * volume) - 1.0).abs() > 0.5, "the check can fail");
    }

    /// Two masses that chatter and come to rest on an oblique stop, its direction a multiple of (3, −4)/5.
    fn oblique(length: f64) -> System {
        let (matrix, row) = (|values: &[f64]| DMatrix::from_row_slice(2, 2, values), DVector::from_row_slice);
        let direction = row(&[length * 0.6, length * -0.8]);
        System::of_plant(Plant {
            n: 2,
            mass: matrix(&[1.2, 0.0, 0.0, 0.7]),
            damping: matrix(&[0.15, -0.05, -0.05, 0.15]),
            stiffness: matrix(&[1.8, -0.8, -0.8, 2.1]),
            force_sin: row(&[0.3 * 0.36, 0.0]),
            force_cos: row(&[0.5, -0.2]),
            load: row(&[0.2, 0.0]),
            omega: 0.6,
            stops: vec![PlantStop { direction, gap: length * 0.0795, restitution: 0.6 }],
        })
        .unwrap()
    }

    #[test]
    fn a_turn_that_begins_at_rest_on_a_stop_has_its_derivative_whatever_rounding_leaves_of_gap_and_speed() {
        // Two multipliers m = 0.00068792 ± 0.58807938i, by finite differences within the contact, and two that are 0.
        let [sum, squares] =
            [2.0 * 0.000_687_92, 2.0 * (0.000_687_92_f64.powi(2) - 0.588_079_38_f64.powi(2))];
        let state = [
            0.466_972_688_957_293_66,
            0.250_854_516_717_970_27,
            0.068_030_868_259_514_95,
            0.051_023_151_194_636_206,
        ];
        for length in [1.0, 5.0, 0.7, 3.3] {
            let turn = turned(&oblique(length), &DVector::from_row_slice(&state), 1);
            assert!((&turn.end - DVector::from_row_slice(&state)).amax() < 1e-9 && turn.sticking, "{length}");
            let traces = [turn.jacobian.trace(), (&turn.jacobian * &turn.jacobian).trace()];
            assert!((traces[0] - sum).abs() < 1e-5, "{length}: {traces:?}");
            assert!((traces[1] - squares).abs() < 1e-5, "{length}: {traces:?}");
        }
        let beside = turned(
            &oblique(1.0),
            &DVector::from_row_slice(&[state[0] - 0.1, state[1], state[2], state[3]]),
            1,
        );
        assert!(((&beside.jacobian * &beside.jacobian).trace() - squares).abs() > 1e-4, "the check can fail");
    }

    /// A turn of which only the strobe states matter.
    fn striding(strobes: &[f64]) -> Turn {
        Turn {
            end: DVector::zeros(1),
            strobes: strobes.iter().map(|&value| DVector::from_element(1, value)).collect(),
            jacobian: DMatrix::zeros(1, 1),
            half: None,
            impacts: Vec::new(),
            sticking: false,
            peak: 0.0,
            met: 0,
            loss: Loss::none(Contact::FREE),
            hardest: None,
        }
    }

    #[test]
    fn the_shorter_period_is_the_smallest_divisor_that_returns() {
        let shorter = |strobes: &[f64]| striding(strobes).shorter(strobes.len() as u32, 0.125);
        assert_eq!(shorter(&[1.0]), None);
        assert_eq!(shorter(&[1.0, 1.0, 1.0, 1.0, 1.0, 1.0]), Some(1));
        assert_eq!(shorter(&[1.0, 2.0, 1.0, 2.0, 1.0, 2.0]), Some(2));
        assert_eq!(shorter(&[1.0, 2.0, 3.0, 1.0, 2.0, 3.0]), Some(3));
        // A return after a number that is no divisor is none, and so is one that is too far away.
        assert_eq!(shorter(&[1.0, 2.0, 3.0, 4.0, 1.0, 2.0]), None);
        assert_eq!(shorter(&[1.0, 2.0, 1.125, 2.0]), Some(2));
        assert_eq!(shorter(&[1.0, 2.0, 1.126, 2.0]), None);
    }

    #[test]
    fn a_trajectory_that_is_not_finite_makes_no_turn() {
        let system = Ball::STABLE.system();
        for wrong in [f64::NAN, f64::INFINITY] {
            let start = DVector::from_row_slice(&[-0.1, wrong]);
            assert!(Turn::from(follower(&system).as_mut(), &Flow::new(&system), &start, 1).is_none());
        }
    }
}
