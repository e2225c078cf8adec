//! Where stops stand, in words.

use crate::system::{BUILTIN, Family, StopPlace};

#[test]
fn places_are_written_as_one_would() {
    let place = |direction: &[&str], gap: &str| StopPlace::of(direction.iter().copied(), gap).to_string();
    for (direction, gap, text) in [
        (&["1"][..], "delta", "x1 = +delta"),
        (&["-1"], "delta", "x1 = -delta"),
        (&["-1"], "0", "x1 = 0"),
        (&["-1"], "0.5", "x1 = -0.5"),
        (&["0", "1"], "beta*delta", "x2 = +beta*delta"),
        (&["0", "-1", "0"], "a + b", "x2 = -(a + b)"),
        (&["1"], "a - b", "x1 = a - b"),
        (&["1", "-1"], "sigma", "x1 - x2 = sigma"),
        (&["-1", "1"], "sigma", "-x1 + x2 = sigma"),
        (&["2", "0", "-mu"], "1", "2*x1 - mu*x3 = 1"),
        (&["1 - mu", "1"], "s", "(1 - mu)*x1 + x2 = s"),
    ] {
        assert_eq!(place(direction, gap), text);
    }
}

#[test]
fn every_stop_of_the_built_in_families_has_a_place_and_a_plain_name() {
    let mut places = Vec::new();
    for builtin in BUILTIN {
        let family = Family::builtin(builtin.name);
        for (i, stop) in family.stops().iter().enumerate() {
            assert_eq!(family.stop_like(&stop.plain_name().to_lowercase()), Some(i));
            places.push(format!("{} {}", stop.plain_name(), family.stop_place(i)));
        }
    }
    assert!(
        ["A x1 = +delta", "B x1 = -delta", "A x1 - x2 = sigma"]
            .iter()
            .all(|p| places.contains(&p.to_string()))
    );
    assert_eq!(Family::paper().stop_like("C"), None);
}
