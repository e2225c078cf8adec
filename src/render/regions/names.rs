//! The words of the picture: title, legend and notes.

use super::census::{Census, Region};
use crate::figure::{Entry, Paint, Text};
use crate::plane::{Plane, Quantity, Start};
use crate::render::motion::Motion;
use crate::render::{places, symbols};

/// How many of a group's paints its sample shows.
const SAMPLES: usize = 4;

/// The title in pieces that belong together: the fixed parameters and the start.
pub fn title<T>(plane: &Plane<T>) -> Vec<Text> {
    let varied = |quantity| [plane.x.quantity, plane.y.quantity].contains(&quantity);
    let mut title = symbols::equations(&plane.parameters, varied);
    let mirrored = plane.start == Start::Symmetric && is_mirrored(plane);
    title.extend(symbols::start(plane.start, mirrored, plane.parameters.family(), |component| {
        varied(Quantity::Start(component))
    }));
    title
}

/// Whether systems of the plane have a mirror, as far as those along its edges tell.
fn is_mirrored<T>(plane: &Plane<T>) -> bool {
    let bottom = (0..plane.x.count).map(|column| (column, 0));
    let left = (0..plane.y.count).map(|row| (0, row));
    bottom.chain(left).any(|(column, row)| plane.parameters_at(column, row).has_mirror())
}

/// The rows of the legend: at most `rows`, everything that is not periodic among them, the rarest motions grouped with
/// those that have no colour of their own.
pub(super) fn entries(census: &Census, rows: usize, shares: bool) -> Vec<Entry> {
    let all = census.cells as f64;
    let value = |cells: u64| shares.then(|| percentage(cells as f64 / all).into());
    let periodic = |region: &&Region| region.is_periodic();
    let named = names(&census.regions.iter().filter(periodic).collect::<Vec<_>>(), census, rows);
    let is_named =
        |region: &&Region| !periodic(region) || region.motion.is_some_and(|own| named.contains(&own));
    let single = |region: &Region| Entry {
        paints: vec![region.paint],
        name: region.name.as_str().into(),
        value: value(region.cells),
    };
    let mut entries: Vec<Entry> = census.regions.iter().filter(is_named).map(single).collect();
    let group: Vec<&Region> = census.regions.iter().filter(|region| !is_named(region)).collect();
    if !group.is_empty() {
        let mut paints: Vec<Paint> = Vec::new();
        for region in group.iter().rev() {
            if !paints.contains(&region.paint) && paints.len() < SAMPLES {
                paints.push(region.paint);
            }
        }
        entries.push(Entry {
            paints,
            name: format!("other periodic ({} motions)", group.len()).into(),
            value: value(group.iter().map(|region| region.cells).sum()),
        });
    }
    entries
}

/// The periodic motions that get a row of their own: the most frequent ones that nothing else looks like.
fn names(periodic: &[&Region], census: &Census, rows: usize) -> Vec<Motion> {
    let room = rows.saturating_sub(census.indispensable());
    let of = |regions: &[&Region]| regions.iter().filter_map(|region| region.motion).collect();
    let shared = periodic.iter().filter(|region| !region.distinct).count();
    // A motion that shares its paint with none needs no group.
    if shared <= 1 && periodic.len() <= room {
        return of(periodic);
    }
    let distinct: Vec<&Region> = periodic.iter().copied().filter(|region| region.distinct).collect();
    let shown = distinct.len().min(room.saturating_sub(1));
    of(&distinct[..shown])
}

/// The meaning of the labels, in pieces that belong together; of N = 0 where a region has it. Stops are called by where they stand, or
/// by their `names`.
pub fn definition(census: &Census, names: bool) -> Vec<Text> {
    let mut pieces = places::label_definition(census.family, names);
    if census.regions.iter().any(|region| region.name.starts_with("0-")) {
        // Only control, which may shift the phase, has motions of less than half a forcing period.
        pieces.extend([
            Text::new().italic("N").upright(" = 0: flights under control"),
            Text::from("of less than half a forcing period,"),
            Text::from("since corrections jump in phase"),
        ]);
    }
    pieces
}

/// A share of the plane, to a tenth of a percent.
fn percentage(share: f64) -> String {
    let percent = 100.0 * share;
    if percent < 0.05 { "< 0.1 %".into() } else { format!("{percent:.1} %") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Counts;
    use crate::analysis::Regime;
    use crate::model::Setting;
    use crate::plane::{Axis, RegionMap, Start, Window};
    use crate::render::example;
    use crate::system::Family;

    fn census(map: &RegionMap) -> Census {
        Census::of(map, Window::whole(&map.plane)).unwrap()
    }

    fn title_of(plane: &Plane) -> String {
        title(plane).iter().map(Text::plain).collect::<Vec<_>>().join(" ")
    }

    /// Without a mirror there is no symmetric motion to begin on; where one cell has it, that is said.
    #[test]
    fn the_title_tells_how_systems_without_a_mirror_begin() {
        let plane = |family: &str, x: &str| {
            let family = Family::builtin(family);
            Plane {
                x: Axis::of_family(x, family).unwrap(),
                y: Axis::of_family("r=0.2:0.8:3", family).unwrap(),
                parameters: Setting::defaults(family),
                ..example::map(4, 3).plane
            }
        };
        for (family, x, mirrored) in [
            ("shaw-holmes", "sigma=0:1:4", false),
            ("bouncing-ball", "Gamma=1:2:4", false),
            ("two-sided", "delta=0.1:0.4:4", false),
            ("two-sided", "beta=0.5:2:4", true),
            ("impact-pair", "nu=1:2:4", true),
            ("impact-damper", "delta=1:2:4", true),
        ] {
            let title = title_of(&plane(family, x));
            assert!(title.ends_with("start at rest") != mirrored, "{title}");
            assert!(title.contains("1-1-1 motion") == mirrored, "{title}");
        }
    }

    #[test]
    fn the_title_tells_what_the_axes_do_not() {
        let mut plane = example::map(4, 3).plane;
        assert_eq!(
            title_of(&plane),
            "ζ = 0.1, r = 0.8, μm = μk = μc = 0.5, f20 = 0, start on the 1-1-1 motion, else at rest"
        );
        plane.parameters = plane.parameters.with_named("mu_k", 0.25);
        plane.start = Start::State([0.05, -1.5, 0.0, 1.0 / 3.0].into());
        assert_eq!(
            title_of(&plane),
            "ζ = 0.1, r = 0.8, μm = 0.5, μk = 0.25, μc = 0.5, f20 = 0, \
             start x1 = 0.05, x2 = −1.5, v1 = 0, v2 = 0.333333"
        );
        plane.x = "x2=0:1:4".parse().unwrap();
        plane.start = Start::Rest;
        assert!(title_of(&plane).ends_with("start x1 = 0, v1 = 0, v2 = 0"));
        assert!(title_of(&plane).starts_with("ω = 3.7, ζ"));
    }

    #[test]
    fn the_legend_keeps_within_its_rows_and_misses_nothing() {
        let census = census(&example::map(120, 90));
        let motions = census.regions.len();
        let fixed = census.indispensable();
        assert!(fixed >= 5 && motions > fixed + 12);
        for rows in fixed + 1..motions + 3 {
            let entries = entries(&census, rows, true);
            assert!(entries.len() <= rows, "{rows}: {}", entries.len());
            for regime in [Regime::Chaotic, Regime::Failed, Regime::NoImpact] {
                assert!(entries.iter().any(|entry| entry.name.plain() == regime.name()));
            }
            let named = |entry: &&Entry| !entry.name.plain().starts_with("other");
            let singles = entries.iter().filter(named).count();
            let group = entries.iter().find(|entry| !named(entry));
            let grouped = group.map_or(0, |entry| {
                entry.name.plain().split(['(', ' ']).find_map(|word| word.parse().ok()).unwrap()
            });
            assert_eq!(singles + grouped, motions, "{rows}");
            assert_ne!(grouped, 1, "{rows}");
        }
    }

    #[test]
    fn a_motion_of_no_forcing_period_is_explained_where_there_is_one() {
        let mut map = example::map(40, 30);
        let explained = |map: &RegionMap| {
            definition(&census(map), false).iter().any(|piece| piece.plain().contains("jump in phase"))
        };
        assert!(!explained(&map));
        let verdict = &mut map.verdicts[7];
        (verdict.regime, verdict.n, verdict.counts) = (Regime::Periodic, 0, Counts::new(&[0, 1]));
        assert!(explained(&map));
    }

    #[test]
    fn shares_add_up() {
        let census = census(&example::map(120, 90));
        let shares = entries(&census, 18, true).into_iter().map(|entry| entry.value.unwrap().plain());
        let total: f64 = shares.filter_map(|share| share.strip_suffix(" %")?.parse::<f64>().ok()).sum();
        assert!((99.0..101.0).contains(&total), "{total}");
        assert_eq!(percentage(1e-6), "< 0.1 %");
        assert_eq!(percentage(0.1234), "12.3 %");
    }
}
