//! Curves of other oscillators than the paper's, held to closed forms and to what happens on either side of them.

use std::f64::consts::PI;

use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{Cpu, Unwatched};
use impact_atlas::curves::{Criticality, Curve, CurvePoint, End, Kind, bifurcation_curves};
use impact_atlas::model::{Setting, StateVector, System};
use impact_atlas::paper::named;
use impact_atlas::plane::{Axis, Plane, RegionMap, Start};
use impact_atlas::sweep::sweep;
use impact_atlas::system::{Family, Plant, PlantStop};
use impact_atlas::theory::{PeriodicMotion, settled_motion};
use nalgebra::{Complex, DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::of;

const SCHEDULE: Schedule = Schedule { transient: 200, observe: 100, max_period: 8, fixed_periods: false };

/// A map of a plane of a family, the parameters that are not varied at their defaults but for what is set.
fn map_of(family: &'static Family, axes: [&str; 2], set: &[(&str, f64)], start: Start) -> RegionMap {
    let [x, y] = axes.map(|axis| Axis::of_family(axis, family).unwrap());
    let defaults = Setting::defaults(family);
    let parameters = set.iter().fold(defaults, |all, (name, value)| all.with_named(name, *value));
    sweep(&Plane { x, y, parameters, start, task: SCHEDULE }, &Cpu, &Unwatched).unwrap()
}

fn from(state: &[f64]) -> Start {
    Start::State(StateVector::from_slice(state).unwrap())
}

fn curves(map: &RegionMap) -> Vec<Curve> {
    bifurcation_curves(map, 2).unwrap().curves
}

fn setting(map: &RegionMap, [x, y]: [f64; 2]) -> Setting {
    let names = [map.plane.x.quantity, map.plane.y.quantity].map(|quantity| quantity.name());
    map.plane.parameters.with_named(names[0], x).with_named(names[1], y)
}

/// The 1-1 motion of the ball on the shaken table is born at Γ = π(1 − e)/(1 + e) and doubles its period at
/// Γ² = (π(1 − e)/(1 + e))² + (2(1 + e²)/(1 + e)²)².
#[test]
fn the_ball_on_the_table_is_where_it_can_be_written_down() {
    let birth = |e: f64| PI * (1.0 - e) / (1.0 + e);
    let doubling = |e: f64| birth(e).hypot(2.0 * (1.0 + e * e) / (1.0 + e).powi(2));
    assert!(
        (birth(0.5) - std::f64::consts::FRAC_PI_3).abs() < 5e-7 && (doubling(0.5) - 1.526824).abs() < 5e-7
    );
    assert!((birth(0.8) - 0.349066).abs() < 5e-7 && (doubling(0.8) - 1.070836).abs() < 5e-7);
    let ball = Family::builtin("bouncing-ball");
    let map = map_of(ball, ["r=0.35:0.95:24", "Gamma=0.05:2.4:30"], &[], from(&[0.0, 2.0]));
    let found = curves(&map);
    for (kind, formula) in [(Kind::Fold, &birth as &dyn Fn(f64) -> f64), (Kind::PeriodDoubling, &doubling)] {
        let [curve] = of(&found, kind, "1-1", false)[..] else { panic!("one {kind:?} of 1-1") };
        for point in &curve.points {
            assert!((point.y - formula(point.x)).abs() < 1e-7, "{kind:?} at {point:?}: {}", formula(point.x));
            assert!((point.y - formula(point.x + 1e-4)).abs() > 1e-5, "the check can fail");
            assert!(point.bounding, "{point:?}");
        }
        let e = |i: usize| curve.points[i].x;
        let [first, last] = [e(0).min(e(curve.points.len() - 1)), e(0).max(e(curve.points.len() - 1))];
        // To the borders: at e = 0.35 both lie on the plane.
        assert!(first < 0.3501 && last > 0.9499, "{kind:?} from {first} to {last}");
    }
    assert!(
        named(&found, &map.plane).iter().all(|stretch| stretch.name.is_none()),
        "L1 to L7 are the paper's"
    );
}

/// A family of one plant, in whose file ω and the gap of the first stop are parameters.
fn family_of(plant: &Plant) -> &'static Family {
    let row = |values: Vec<f64>| {
        let texts: Vec<String> = values.iter().map(|value| format!("\"{value}\"")).collect();
        format!("[{}]", texts.join(", "))
    };
    let matrix = |m: &DMatrix<f64>| {
        let rows: Vec<String> = m.row_iter().map(|r| row(r.iter().copied().collect())).collect();
        format!("[{}]", rows.join(", "))
    };
    let vector = |v: &DVector<f64>| row(v.iter().copied().collect());
    let mut text = format!(
        "name = \"drawn\"\n[parameters]\nomega = {{ default = {}, above = 0 }}\ngap = {}\n[system]\nfrequency = \"omega\"\n\
         mass = {}\ndamping = {}\nstiffness = {}\nforce_sin = {}\nforce_cos = {}\nload = {}\n",
        plant.omega,
        plant.stops[0].gap,
        matrix(&plant.mass),
        matrix(&plant.damping),
        matrix(&plant.stiffness),
        vector(&plant.force_sin),
        vector(&plant.force_cos),
        vector(&plant.load)
    );
    for (i, stop) in plant.stops.iter().enumerate() {
        let gap = if i == 0 { "gap".to_owned() } else { stop.gap.to_string() };
        let direction = vector(&stop.direction);
        text += &format!(
            "[[stop]]\nname = \"S{i}\"\ndirection = {direction}\ngap = \"{gap}\"\nrestitution = \"{}\"\n",
            stop.restitution
        );
    }
    Family::kept(&text, "drawn.toml").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// A damped plant of n coordinates with loads of all kinds, its stops in any directions.
fn drawn(rng: &mut ChaCha8Rng, n: usize, stops: usize) -> Plant {
    let mut vector = |low: f64, high: f64| DVector::from_fn(n, |_, _| rng.random_range(low..high));
    let directions: Vec<DVector<f64>> = (0..stops).map(|_| vector(-1.0, 1.0)).collect();
    let loads = [vector(-1.0, 1.0), vector(-1.0, 1.0), vector(-0.3, 0.3)];
    let mut definite = |least: f64, spread: f64| {
        let part = DMatrix::from_fn(n, n, |_, _| rng.random_range(-spread..spread));
        &part * part.transpose() + DMatrix::identity(n, n) * least
    };
    let (mass, damping, stiffness) = (definite(0.8, 0.4), definite(0.25, 0.3), definite(1.0, 0.8));
    let [force_sin, force_cos, load] = loads;
    let stop = |direction: DVector<f64>, i: usize| PlantStop {
        direction,
        gap: 0.6 + 0.3 * i as f64,
        restitution: 0.7,
    };
    let stops = directions.into_iter().enumerate().map(|(i, direction)| stop(direction, i)).collect();
    Plant { n, mass, damping, stiffness, force_sin, force_cos, load, omega: 1.3, stops }
}

/// How far the forced response goes towards each stop, less its gap.
fn beyond(plant: &Plant) -> Vec<f64> {
    let complex = |m: &DMatrix<f64>| m.map(|value| Complex::new(value, 0.0));
    let i = Complex::new(0.0, plant.omega);
    let dynamic = complex(&plant.stiffness) + complex(&plant.damping) * i + complex(&plant.mass) * (i * i);
    // Re (c − is) e^(iφ) = c cos φ + s sin φ.
    let load = plant.force_cos.zip_map(&plant.force_sin, Complex::new).map(|z| z.conj());
    let swing = dynamic.lu().solve(&load).unwrap();
    let mean = plant.stiffness.clone().lu().solve(&plant.load).unwrap();
    let reach = |d: &DVector<f64>| {
        let swing: Complex<f64> = d.iter().zip(swing.iter()).map(|(d, x)| x * *d).sum();
        d.dot(&mean) + swing.norm()
    };
    plant.stops.iter().map(|stop| reach(&stop.direction) - stop.gap).collect()
}

#[test]
fn forced_motion_grazes_any_stop_of_any_plant_at_its_reach() {
    let mut rng = ChaCha8Rng::seed_from_u64(14);
    let (mut checked, mut at_others, mut ended) = (0, 0, 0);
    for (n, stops) in [(1, 1), (2, 1), (2, 2), (3, 2), (3, 3), (4, 2), (4, 4)] {
        let plant = drawn(&mut rng, n, stops);
        let map = map_of(family_of(&plant), ["omega=0.4:3:8", "gap=-0.2:1.6:6"], &[], Start::Rest);
        // Motions with impacts are followed on one of the larger plants, which takes long.
        let longest = if [n, stops] == [3, 2] { 2 } else { 0 };
        let found = bifurcation_curves(&map, longest).unwrap().curves;
        let grazing = of(&found, Kind::Grazing, "no impact", false);
        for curve in &grazing {
            let touched = curve.touches.unwrap().index();
            at_others += usize::from(touched > 0);
            ended += usize::from(curve.ends.contains(&End::Grazes));
            for point in &curve.points {
                let beyond = beyond(&setting(&map, [point.x, point.y]).plant().unwrap());
                assert!(beyond[touched].abs() < 1e-7, "{n}: stop {touched} at {point:?}: {beyond:?}");
                assert!(beyond.iter().all(|&beyond| beyond < 1e-6), "{n}: {beyond:?} beyond another");
                checked += 1;
            }
        }
        // None is missing: wherever the first stop is just touched, and no other crossed, there is a curve.
        for k in 0..12 {
            let omega = 0.45 + 0.2 * f64::from(k);
            let at = |gap: f64| setting(&map, [omega, gap]).plant().unwrap();
            let gap = beyond(&at(0.0))[0];
            let others = beyond(&at(gap));
            if !(-0.19..1.59).contains(&gap) || others[1..].iter().any(|&beyond| beyond > -1e-3) {
                continue;
            }
            let near = |curve: &&Curve| {
                super::crossings_upright(curve, omega).iter().any(|y| (y - gap).abs() < 3e-3)
            };
            assert!(grazing.iter().any(near), "{n}: nothing at {omega}, {gap}");
            let far = |y: &f64| (y - gap - 0.05).abs() < 3e-3;
            assert!(
                !grazing.iter().any(|c| super::crossings_upright(c, omega).iter().any(far)),
                "the check can fail"
            );
        }
    }
    assert!(checked > 1000 && at_others > 2 && ended > 1, "{checked} {at_others} {ended}");
}

/// The motion of a curve's label at a cell near one of its points, followed from there by Newton's method to other places.
struct Walked<'a> {
    map: &'a RegionMap,
    at: [f64; 2],
    motion: PeriodicMotion,
}

impl<'a> Walked<'a> {
    fn near(map: &'a RegionMap, curve: &Curve, point: &CurvePoint) -> Option<Self> {
        let (x, y) = (map.plane.x.place(point.x), map.plane.y.place(point.y));
        let mut cells: Vec<(u32, u32)> = (0..map.plane.x.count)
            .flat_map(|column| (0..map.plane.y.count).map(move |row| (column, row)))
            .filter(|&(c, r)| (f64::from(c) - x).hypot(f64::from(r) - y) < 6.0)
            .filter(|&(c, r)| map.at(c, r).regime == Regime::Periodic)
            .collect();
        cells.sort_by(|a, b| {
            let away = |&(c, r): &(u32, u32)| (f64::from(c) - x).hypot(f64::from(r) - y);
            away(a).total_cmp(&away(b))
        });
        cells.into_iter().find_map(|(column, row)| {
            let verdict: &Verdict = map.at(column, row);
            let system = System::new(map.plane.parameters_at(column, row)).unwrap();
            let motion = settled_motion(&system, &verdict.state[..], verdict.n.into()).ok()?;
            let image = || motion.mirror_image(&system);
            let is_it = |m: &PeriodicMotion| {
                m.label() == curve.motion.label() && m.is_symmetric() == curve.motion.symmetric
            };
            let motion = Some(motion.clone()).filter(is_it).or_else(|| image().filter(is_it))?;
            let at = [map.plane.x.value(column), map.plane.y.value(row)];
            Some(Walked { map, at, motion })
        })
    }

    fn system(&self, at: [f64; 2]) -> System {
        System::new(setting(self.map, at)).unwrap()
    }

    /// The same motion somewhere else, in so many steps; none where it ceases to exist on the way.
    fn to(&self, at: [f64; 2], steps: u32) -> Option<Self> {
        let mut motion = self.motion.clone();
        for k in 1..=steps {
            let share = f64::from(k) / f64::from(steps);
            let here = [0, 1].map(|i| self.at[i] + share * (at[i] - self.at[i]));
            let next = PeriodicMotion::refine(&self.system(here), &motion.pattern, &motion.sections).ok()?;
            let leaps = next.sections.len() != motion.sections.len()
                || next.sections.iter().zip(&motion.sections).any(|(a, b)| (a - b).amax() > 0.3);
            // A motion of half the period, gone round twice, solves the same equations.
            let half = next.sections.len() / 2;
            let twice = half > 0
                && next.sections.len() == 2 * half
                && next.sections[..half]
                    .iter()
                    .zip(&next.sections[half..])
                    .all(|(a, b)| (a - b).amax() < 1e-6);
            if leaps || (twice && !next.is_symmetric()) {
                return None;
            }
            motion = next;
        }
        Some(Walked { map: self.map, at, motion })
    }

    /// Whether the same motion at the place of another is that one: beyond a fold Newton's method may come upon another
    /// branch of the same label, from which there is no way back.
    fn leads_back_to(&self, other: &Self) -> bool {
        self.to(other.at, 30).is_some_and(|back| {
            let pairs = back.motion.sections.iter().zip(&other.motion.sections);
            pairs.map(|(a, b)| (a - b).amax()).fold(0.0, f64::max) < 1e-6
        })
    }

    /// The multipliers of a turn, largest modulus first.
    fn multipliers(&self) -> Option<Vec<Complex<f64>>> {
        let system = self.system(self.at);
        self.motion.half_multipliers(&system).or_else(|| self.motion.multipliers(&system))
    }

    /// How far the multipliers are from what is critical on a curve of some kind; none where they do not tell.
    fn distance_from(&self, kind: Kind) -> Option<f64> {
        let values = self.multipliers()?;
        let nearest = |to: f64| values.iter().map(|value| (value - to).norm()).fold(f64::INFINITY, f64::min);
        match kind {
            Kind::Fold => Some(nearest(1.0)),
            Kind::PeriodDoubling | Kind::Pitchfork => Some(nearest(-1.0)),
            Kind::NeimarkSacker => {
                values.iter().find(|value| value.im != 0.0).map(|value| (value.norm() - 1.0).abs())
            }
            Kind::Grazing => None,
        }
    }

    /// Whether this motion is the one that is lost on a curve of some kind, of which `closer` is much nearer to it: another of
    /// the same label may be stable here as well.
    fn is_lost_by(&self, kind: Kind, closer: Option<Self>) -> bool {
        if kind == Kind::Grazing {
            return true;
        }
        let distances = self.distance_from(kind).zip(closer.and_then(|closer| closer.distance_from(kind)));
        distances.is_some_and(|(here, closer)| closer < 0.7 * here)
    }

    fn is_stable(&self) -> bool {
        self.multipliers().is_some_and(|values| values[0].norm() < 1.0)
    }

    /// What a trajectory beside the motion settles on.
    fn settles_on(&self) -> Verdict {
        let system = self.system(self.at);
        let mut start = self.motion.at_phase_zero(&system);
        let last = start.len() - 1;
        start[last] += 1e-7;
        let start = Start::State(system.between_stops(StateVector::from_slice(&start).unwrap()));
        let schedule = Schedule { transient: 3000, observe: 200, ..SCHEDULE };
        let one = |axis: &Axis, value: f64| Axis::new(axis.quantity, value, value, 1).unwrap();
        let [x, y] = [one(&self.map.plane.x, self.at[0]), one(&self.map.plane.y, self.at[1])];
        let plane = Plane { x, y, parameters: self.map.plane.parameters, start, task: schedule };
        sweep(&plane, &Cpu, &Unwatched).unwrap().verdicts[0]
    }
}

/// The least distance from a curve at which its sides are looked at, in sides of the plane.
const NEAREST: f64 = 1e-4;

/// Whether a trajectory beside an unstable motion settles on one of a multiple of twice its period, or on nothing that
/// repeats.
fn doubled(motion: &Walked, settled: &Verdict) -> bool {
    settled.regime != Regime::Periodic || u32::from(settled.n).is_multiple_of(2 * motion.motion.pattern.n())
}

/// Holds what happens a little beside a point of a curve to what the curve is called; whether it could be told.
fn sides_agree(map: &RegionMap, curve: &Curve, k: usize) -> bool {
    let point = &curve.points[k];
    let sides = [&map.plane.x, &map.plane.y].map(|axis| axis.last - axis.first);
    let [a, b] = [&curve.points[k - 1], &curve.points[k + 1]];
    let along = [(b.x - a.x) / sides[0], (b.y - a.y) / sides[1]];
    let length = along[0].hypot(along[1]);
    let beside =
        |by: f64| [point.x - by * sides[0] * along[1] / length, point.y + by * sides[1] * along[0] / length];
    let Some(walked) = Walked::near(map, curve, point) else { return false };
    let within = |at: [f64; 2]| {
        let [x, y] = [map.plane.x.share(at[0]), map.plane.y.share(at[1])];
        (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y)
    };
    let context = format!("{:?} of {} at {point:?}", curve.kind, curve.motion.label());
    // Nearer where something else happens beside the curve.
    for off in [1.5e-3, 4e-4, NEAREST] {
        if ![off, -off].map(beside).into_iter().all(within) {
            continue;
        }
        let stable = [off, -off].into_iter().find_map(|by| {
            let there = walked.to(beside(by), 60).filter(Walked::is_stable)?;
            Some((there, by))
        });
        let stable =
            stable.filter(|(there, by)| there.is_lost_by(curve.kind, walked.to(beside(by / 16.0), 60)));
        let Some((stable, by)) = stable else { continue };
        let other = stable.to(beside(-by), 30);
        if matches!(curve.kind, Kind::Fold | Kind::Grazing) {
            assert!(!other.is_some_and(|other| other.leads_back_to(&stable)), "{context}: it goes on beyond");
        } else {
            let Some(other) = other else { continue };
            let settled = lost(curve, &other, &context);
            let soft = point.criticality == Some(Criticality::Supercritical);
            if soft && curve.kind == Kind::PeriodDoubling && !doubled(&other, &settled) {
                // The motion of twice the period may be lost in its turn, nearer than this.
                assert!(off > NEAREST, "{context}: {settled:?}");
                continue;
            }
        }
        let settled = stable.settles_on();
        let found = (settled.regime, settled.label());
        assert!(
            found == (Regime::Periodic, stable.motion.label()) || settled.regime == Regime::Unresolved,
            "{context}: {settled:?}"
        );
        return true;
    }
    false
}

/// Holds a motion on the other side of a smooth curve to what it is lost by there; what a trajectory beside it settles on.
fn lost(curve: &Curve, motion: &Walked, context: &str) -> Verdict {
    let critical = motion.multipliers().unwrap()[0];
    assert!(critical.norm() > 1.0, "{context}: it is stable on both sides, {critical}");
    let settled = motion.settles_on();
    match curve.kind {
        Kind::PeriodDoubling => {
            assert!(critical.im == 0.0 && critical.re < -1.0, "{context}: {critical}");
            assert_ne!(settled.label(), motion.motion.label(), "{context}");
        }
        Kind::Pitchfork => {
            assert!(critical.im == 0.0 && critical.re < -1.0, "{context}: {critical}");
            assert!(!settled.symmetric, "{context}: {settled:?}");
        }
        _ => assert!(critical.im != 0.0, "{context}: {critical}"),
    }
    settled
}

/// Samples every curve between its special points; how many places of each kind could be told.
fn sample(map: &RegionMap, curves: &[Curve]) -> Vec<(Kind, usize)> {
    let mut told: Vec<(Kind, usize)> = Vec::new();
    for curve in curves.iter().filter(|curve| curve.motion.count() > 0) {
        let plain = |k: &usize| curve.points[k - 1..=k + 1].iter().all(|p| p.bounding && p.special.is_none());
        let places: Vec<usize> = (1..curve.points.len().saturating_sub(1)).filter(plain).collect();
        for i in 1..6 {
            let Some(&k) = places.get(i * places.len() / 6) else { continue };
            if sides_agree(map, curve, k) {
                match told.iter_mut().find(|(kind, _)| *kind == curve.kind) {
                    Some((_, count)) => *count += 1,
                    None => told.push((curve.kind, 1)),
                }
            }
        }
    }
    told
}

fn count(told: &[(Kind, usize)], kind: Kind) -> usize {
    told.iter().find(|(other, _)| *other == kind).map_or(0, |(_, count)| *count)
}

#[test]
fn curves_of_the_one_sided_oscillator_are_what_they_are_called() {
    let family = Family::builtin("shaw-holmes");
    let axes = ["omega=2.2:3.4:110", "sigma=-0.3:0.5:70"];
    let map = map_of(family, axes, &[("zeta", 0.05), ("r", 0.7)], Start::Rest);
    let found = curves(&map);
    let told = sample(&map, &found);
    let [doublings, folds, grazings] =
        [Kind::PeriodDoubling, Kind::Fold, Kind::Grazing].map(|kind| count(&told, kind));
    // (Most boundaries of this map are those of basins: motions coexist.)
    assert!(doublings >= 4 && folds + grazings >= 4, "{told:?}");
}

#[test]
fn curves_of_the_impact_pair_are_what_they_are_called() {
    let family = Family::builtin("impact-pair");
    let map = map_of(family, ["nu=0.4:6:100", "r=0.3:0.9:60"], &[], Start::Symmetric);
    let found = curves(&map);
    let told = sample(&map, &found);
    assert!(count(&told, Kind::Pitchfork) >= 3 && count(&told, Kind::Fold) >= 2, "{told:?}");
    assert!(told.iter().map(|(_, count)| count).sum::<usize>() >= 12, "{told:?}");
}

/// Two masses that hit each other: four multipliers, one stop between the two, no mirror.
#[test]
fn masses_that_hit_each_other_have_curves() {
    let family = Family::builtin("colliding-pair");
    let map = map_of(family, ["omega=0.8:2.6:60", "sigma=0.02:0.9:40"], &[], Start::Rest);
    let found = curves(&map);
    let told = sample(&map, &found);
    assert!(told.iter().map(|(_, count)| count).sum::<usize>() >= 5, "{told:?}");
    assert!(found.iter().all(|curve| curve.motion.image.is_none() && !curve.motion.symmetric));
}
