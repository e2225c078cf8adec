//! A bifurcation curve, point by point.

use super::condition::Kind;
use super::spans::spans;
use super::symmetry::stops_of;
use crate::analysis::{Regime, Verdict, motion_label};
use crate::dynamics::Stop;
use crate::plane::Plane;
use crate::system::named;
use crate::theory::{Pattern, StopSet};

/// A bifurcation curve in the plane of two parameters; non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What happens on it.
    pub kind: Kind,
    /// Its motion.
    pub motion: CurveMotion,
    /// The stop that is touched, for grazing.
    pub touches: Option<Stop>,
    /// Its points, in order.
    pub points: Vec<CurvePoint>,
    /// Why it begins and ends where it does.
    pub ends: [End; 2],
}

/// The motion that a curve is about.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CurveMotion {
    /// N, forcing periods.
    pub n: u32,
    /// Impacts at each stop in one period, in the order of labels: p and q of the paper's oscillator.
    pub impacts: Vec<u32>,
    /// Those of its mirror image; none where the plane's systems have no mirror.
    pub image: Option<Vec<u32>>,
    /// Whether it is symmetric.
    pub symmetric: bool,
}

impl CurveMotion {
    /// That of a pattern of impacts.
    pub(super) fn of(pattern: &Pattern) -> Self {
        let impacts = pattern.among.in_label_order(&pattern.counts());
        CurveMotion::among(&pattern.among, pattern.n(), impacts, pattern.mirrored)
    }

    /// That of a cell.
    pub(super) fn shown(verdict: &Verdict, stops: &StopSet) -> Self {
        let impacts = verdict.counts.iter().map(|&count| count.into()).collect();
        CurveMotion::among(stops, verdict.n.into(), impacts, verdict.symmetric && stops.has_mirror())
    }

    /// The forced response.
    pub(super) fn without_impact(stops: &StopSet) -> Self {
        CurveMotion::among(stops, 1, vec![0; stops.count()], stops.has_mirror())
    }

    fn among(stops: &StopSet, n: u32, impacts: Vec<u32>, symmetric: bool) -> Self {
        let own = stops.in_plant_order(&impacts);
        let mut image = vec![0; own.len()];
        for (stop, &count) in own.iter().enumerate() {
            image[stops.image(Stop(stop as u8)).index()] = count;
        }
        let image = stops.has_mirror().then(|| stops.in_label_order(&image));
        CurveMotion { n, impacts, image, symmetric }
    }

    /// The motion of a label on a plane, N and the impacts at each stop in the order of labels, or what it is called without
    /// impacts.
    pub fn labelled(label: &str, symmetric: bool, plane: &Plane) -> Option<Self> {
        let stops = stops_of(plane, spans(plane).ok()?);
        if label == Regime::NoImpact.name() {
            return Some(CurveMotion { symmetric, ..CurveMotion::without_impact(&stops) });
        }
        let counts: Option<Vec<u32>> = label.split('-').map(|count| count.parse().ok()).collect();
        let counts = counts?;
        let (&n, impacts) = counts.split_first()?;
        (impacts.len() == stops.count()).then(|| CurveMotion::among(&stops, n, impacts.to_vec(), symmetric))
    }

    /// The motion half a forcing period later with the mirror applied; itself where there is no mirror.
    #[must_use]
    pub fn mirror_image(&self) -> Self {
        let Some(image) = &self.image else { return self.clone() };
        CurveMotion { impacts: image.clone(), image: Some(self.impacts.clone()), ..self.clone() }
    }

    /// Of the motion and its mirror image the one with more impacts at the first stop in which they differ.
    #[must_use]
    pub(super) fn leading(self) -> Self {
        let image = self.mirror_image();
        if image.impacts > self.impacts { image } else { self }
    }

    /// Impacts in one period.
    pub fn count(&self) -> u32 {
        self.impacts.iter().sum()
    }

    /// Whether a cell shows the motion or its mirror image; whether symmetrically or not is another question.
    pub fn is_counted_by(&self, verdict: &Verdict) -> bool {
        let counts = |impacts: &[u32]| {
            verdict.counts.iter().map(|&count| u32::from(count)).eq(impacts.iter().copied())
        };
        if self.count() == 0 {
            return verdict.regime == Regime::NoImpact;
        }
        verdict.regime.is_periodic()
            && u32::from(verdict.n) == self.n
            && (counts(&self.impacts) || self.image.as_deref().is_some_and(counts))
    }

    /// Whether there are motions of its label that are symmetric and others that are not.
    pub fn could_be_symmetric(&self) -> bool {
        self.image.as_ref() == Some(&self.impacts)
    }

    /// N and the impacts at each stop, or what it is called without impacts.
    pub fn label(&self) -> String {
        if self.count() == 0 {
            Regime::NoImpact.name().to_owned()
        } else {
            let impacts: Vec<u16> = self.impacts.iter().map(|&count| count as u16).collect();
            motion_label(self.n, &impacts)
        }
    }
}

/// A point of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// The first parameter.
    pub x: f64,
    /// The second parameter.
    pub y: f64,
    /// Whether what is lost here is taken over by something stable; none where the question has no meaning or no answer.
    pub criticality: Option<Criticality>,
    /// Whether the motion is stable on one side: all its other multipliers lie within the unit circle.
    pub bounding: bool,
    /// Its name, if it is a special one.
    pub special: Option<Special>,
}

named! {
    /// Super- or subcritical, from the sign of the normal-form coefficient.
    #[derive(Hash)]
    pub enum Criticality {
        /// Something stable takes over: the loss is soft.
        Supercritical = "supercritical",
        /// Nothing stable is near: the loss is hard.
        Subcritical = "subcritical",
    }
}

named! {
    /// A point of codimension two on a curve.
    #[derive(Hash)]
    pub enum Special {
        /// Two folds meet.
        Cusp = "cusp",
        /// Two multipliers +1.
        Resonance11 = "1:1 resonance",
        /// Two multipliers −1.
        Resonance12 = "1:2 resonance",
        /// Multipliers e^(±2πi/3).
        Resonance13 = "1:3 resonance",
        /// Multipliers ±i.
        Resonance14 = "1:4 resonance",
        /// Multipliers +1 and −1.
        FoldFlip = "fold-flip",
        /// A multiplier +1 beside a pair on the unit circle.
        FoldNeimarkSacker = "fold-Neimark-Sacker",
        /// A multiplier −1 beside a pair on the unit circle.
        FlipNeimarkSacker = "flip-Neimark-Sacker",
        /// Two pairs on the unit circle.
        DoubleNeimarkSacker = "double Neimark-Sacker",
        /// A Neimark–Sacker bifurcation turns from super- to subcritical.
        Chenciner = "Chenciner",
        /// A period doubling, or pitchfork, turns from super- to subcritical.
        GeneralisedFlip = "generalised flip",
        /// The motion touches a stop: a smooth curve ends, and a grazing curve passes.
        Grazing = "grazing",
        /// On a grazing curve, a multiplier is +1.
        GrazingFold = "grazing-fold",
        /// On a grazing curve, a multiplier is −1.
        GrazingFlip = "grazing-flip",
        /// On a grazing curve, a pair lies on the unit circle.
        GrazingNeimarkSacker = "grazing-Neimark-Sacker",
    }
}

named! {
    /// Why a curve ends.
    #[derive(Hash)]
    pub enum End {
        /// It leaves the plane.
        LeavesPlane = "leaves the plane",
        /// It comes back to where it began.
        Closes = "closes on itself",
        /// A Neimark–Sacker pair meets at +1.
        Resonance11 = "1:1 resonance: the pair of multipliers meets at +1",
        /// A Neimark–Sacker pair meets at −1.
        Resonance12 = "1:2 resonance: the pair of multipliers meets at -1",
        /// Its motion touches a stop on the way.
        Grazes = "the motion grazes a stop in flight",
        /// One of its impacts comes to nothing.
        ImpactVanishes = "an impact of the motion comes to nothing",
        /// Its motion goes over into the simpler one that it was born from, and the path into its twin's.
        Simplifies = "the motion becomes a simpler one",
        /// Newton's method does not converge however short the step.
        Stalled = "cannot be followed further",
        /// It has more points than are computed.
        TooLong = "longer than is computed",
    }
}
