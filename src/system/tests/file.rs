//! Files that are no family: each is refused at its place with the remedy.

use super::super::{BUILTIN, Family, FamilyError};
use super::family::example;

/// The example with one piece replaced, which must occur once.
fn broken(piece: &str, by: &str) -> FamilyError {
    assert_eq!(example().matches(piece).count(), 1, "{piece}");
    Family::parse(&example().replace(piece, by), "mine.toml").unwrap_err()
}

/// The line, from 1, at which a piece of the example begins.
fn line(piece: &str) -> usize {
    1 + example()[..example().find(piece).unwrap()].matches('\n').count()
}

/// Replaces a piece and expects an error at the line of `at`, with this key and these words.
fn refused(piece: &str, by: &str, at: &str, key: &str, words: &[&str]) {
    let error = broken(piece, by);
    let message = error.to_string();
    assert_eq!((error.place.line, error.place.key.as_str()), (line(at), key), "{message}");
    let place = if key.is_empty() { String::new() } else { format!(" {key}:") };
    assert!(message.starts_with(&format!("mine.toml:{}:{place} ", line(at))), "{message}");
    for words in words {
        assert!(message.contains(words), "{message}");
    }
}

const GAP: &str = r#"gap = "sigma""#;
const MASS: &str = r#"mass      = [["1"]]"#;
const ZETA: &str = "zeta = 0.0";
const STOP: &str = r#"direction = ["1"]"#;
const ORDER: &str = r#"label_order = ["A"]"#;

#[test]
fn what_is_not_toml() {
    for text in ["\u{1}PNG", "just words", "{\"json\": 1}", "name = \"a\nb\"", "name = \"a\"\nname = \"b\""] {
        let error = Family::parse(text, "mine.toml").unwrap_err();
        let message = error.to_string();
        assert!(message.starts_with("mine.toml:") && message.contains("this is not TOML: "), "{message}");
        assert_eq!(error.place.key, "");
    }
    refused("frequency = ", "frequency ", "frequency = ", "", &["this is not TOML"]);
    refused(MASS, r#"mass = [["1"]"#, "damping", "", &["this is not TOML"]);
}

#[test]
fn missing_sections_and_keys() {
    let empty = Family::parse("", "mine.toml").unwrap_err().to_string();
    assert_eq!(empty, "mine.toml:1: name: missing: write name = \"…\" before the first section");
    let cut = |from: &str| Family::parse(&example()[..example().find(from).unwrap()], "mine.toml");
    for (from, key) in [("[parameters]", "parameters"), ("[system]", "system"), ("[[stop]]", "stop")] {
        let error = cut(from).unwrap_err();
        assert_eq!((error.place.line, error.place.key.as_str()), (1, key), "{error}");
        assert!(error.to_string().contains("missing: write "), "{error}");
    }
    assert!(cut("[plane]").is_ok(), "the plane is optional");
    refused(MASS, "", "[system]", "system.mass", &["missing: write mass = [[\"1\"]]"]);
    refused(r#"damping   = [["2*zeta"]]"#, "", "[system]", "system.damping", &["missing", "zeros"]);
    refused(GAP, "", "[[stop]]", "stop[1].gap", &["missing: write gap ="]);
    refused("default = 2.8, ", "", "omega =", "parameters.omega.default", &["missing"]);
    refused("x = \"omega=1:4:400\"", "", "[plane]", "plane.x", &["missing"]);
}

#[test]
fn unknown_keys() {
    refused("[plane]", "[plan]", "[plane]", "plan", &["unknown key", "plane"]);
    refused("load      =", "loads =", "load      =", "system.loads", &["force_sin, force_cos, load"]);
    refused(GAP, "gap = \"sigma\"\ngab = 1", "restitution", "stop[1].gab", &["unknown key"]);
    refused("at_most", "atmost", "r = {", "parameters.r.atmost", &["at_least, at_most, above, below"]);
    refused("source = ", "sauce = ", "source = ", "sauce", &["unknown key"]);
}

#[test]
fn values_of_the_wrong_kind() {
    refused("\"Single-sided impact oscillator\"", "3", "name =", "name", &["this is a number", "in quotes"]);
    refused("\"Single-sided impact oscillator\"", "\" \"", "name =", "name", &["empty"]);
    refused(ZETA, "zeta = \"0\"", ZETA, "parameters.zeta", &["this is a text: write a number"]);
    refused(ZETA, "zeta = nan", ZETA, "parameters.zeta", &["nan is not a finite number"]);
    refused(GAP, "gap = inf", GAP, "stop[1].gap", &["inf is not a finite number"]);
    refused(GAP, "gap = true", GAP, "stop[1].gap", &["this is true or false", "expression in quotes"]);
    refused(GAP, "gap = [\"sigma\"]", GAP, "stop[1].gap", &["this is a list"]);
    refused(STOP, "direction = \"1\"", STOP, "stop[1].direction", &["this is a text", "list of expressions"]);
    refused("[[stop]]", "[stop]", "[[stop]]", "stop", &["this is a section", "[[stop]]"]);
    refused("[system]", "[[system]]", "[system]", "system", &["this is a list", "[system]"]);
}

#[test]
fn names_that_expressions_do_not_know() {
    let words = ["`sigm` in `sigm` is not a parameter", "omega, zeta, sigma, r"];
    refused(GAP, "gap = \"sigm\"", GAP, "stop[1].gap", &words);
    refused("[[\"2*zeta\"]]", "[[\"2*\"]]", "damping", "system.damping[1][1]", &["is not an expression"]);
    refused("[[\"2*zeta\"]]", "[[\"zeta(2)\"]]", "damping", "system.damping[1][1]", &["not a function"]);
    refused("[[\"2*zeta\"]]", "[[\"2/0*zeta\"]]", "damping", "system.damping[1][1]", &["divides by zero"]);
    refused("[[\"2*zeta\"]]", "[[\"zeta + nan\"]]", "damping", "system.damping[1][1]", &["`nan`"]);
}

#[test]
fn names_that_parameters_cannot_have() {
    let cases = [
        ("x1", "component of the start"),
        ("v4", "component of the start"),
        ("phase", "forcing phase"),
        ("pi", "meaning of its own"),
        ("sqrt", "meaning of its own"),
        ("2nd", "first no digit"),
        ("\"µ\"", "ASCII letters"),
    ];
    for (name, reason) in cases {
        let key = format!("parameters.{}", name.trim_matches('"'));
        refused(ZETA, &format!("zeta = 0\n{name} = 1"), "sigma = {", &key, &[reason, "choose another name"]);
    }
}

#[test]
fn more_parameters_than_there_is_room_for() {
    let named = |count: usize| {
        let more: Vec<String> = (0..count).map(|i| format!("p{i} = 1")).collect();
        let sum: Vec<String> = (0..count).map(|i| format!("0*p{i}")).collect();
        let gap = format!("gap = \"sigma + {}\"", sum.join(" + "));
        let text = example().replace(ZETA, &format!("{ZETA}\n{}", more.join("\n"))).replace(GAP, &gap);
        Family::parse(&text, "mine.toml").map(|family| family.parameters.len())
    };
    let own = Family::parse(example(), "mine.toml").unwrap().parameters.len();
    assert_eq!(named(32 - own), Ok(32));
    let error = named(33 - own).unwrap_err().to_string();
    assert!(error.contains("at most 32"), "{error}");
}

#[test]
fn parameters_without_a_use() {
    let words = ["no expression uses this parameter"];
    refused(ZETA, "zeta = 0\nspare = 1", "sigma = {", "parameters.spare", &words);
    refused("[[\"2*zeta\"]]", "[[\"0.2\"]]", ZETA, "parameters.zeta", &words);
}

#[test]
fn ranges_that_make_no_sense() {
    let (r, key) = ("at_least = 0, at_most = 1", "parameters.r");
    refused(r, "at_least = 0, above = 0", "r = {", key, &["keep one"]);
    refused(r, "at_least = 1, below = 1", "r = {", key, &["no number lies within these bounds"]);
    refused(r, "at_least = 2, at_most = 1", "r = {", key, &["widen them"]);
    let words = ["the default r = 0.8 is out of range: r must be 1 or greater"];
    refused(r, "at_least = 1", "r = {", "parameters.r.default", &words);
}

#[test]
fn wrong_shapes_and_too_many_coordinates() {
    let words = ["2 rows where 1 should be"];
    refused("[[\"2*zeta\"]]", "[[\"2*zeta\"], [0]]", "damping", "system.damping", &words);
    refused("[[\"2*zeta\"]]", "[[\"2*zeta\", 0]]", "damping", "system.damping[1]", &["2 entries where 1"]);
    refused(MASS, "mass = [[1, 0], [0, 1]]", "damping", "system.damping", &["1 rows where 2 should be"]);
    refused(MASS, "mass = [[1], [1]]", MASS, "system.mass[1]", &["1 entries where 2 should be"]);
    refused(STOP, "direction = [1, 0]", STOP, "stop[1].direction", &["2 entries where 1 should be"]);
    refused("load      = [\"0\"]", "load = [0, 1]", "load ", "system.load", &["2 entries"]);
    refused(MASS, "mass = []", MASS, "system.mass", &["empty"]);
    let five = format!("mass = [{}]", ["[1, 0, 0, 0, 0]"; 5].join(", "));
    refused(MASS, &five, MASS, "system.mass", &["5 coordinates: this version follows 1 to 4"]);
    let stops = "[[stop]]\nname = \"X\"\n".repeat(4) + "[[stop]]";
    refused("[[stop]]", &stops, "[[stop]]", "stop", &["5 stops: this version follows 1 to 4"]);
}

#[test]
fn plants_that_the_defaults_do_not_make() {
    let defaults = "with the default values, ";
    let words = [defaults, "the mass matrix is singular", "change them or the expressions"];
    refused(MASS, "mass = [[0]]", MASS, "system.mass", &words);
    let words = [defaults, "`1/zeta` divides by zero", "(at zeta = 0)"];
    refused(MASS, "mass = [[\"1/zeta\"]]", MASS, "system.mass[1][1]", &words);
    refused(GAP, "gap = \"sqrt(sigma - 1)\"", GAP, "stop[1].gap", &[defaults, "NaN", "(at sigma = 0)"]);
    refused(STOP, "direction = [0]", STOP, "stop[1].direction", &[defaults, "is zero"]);
    let words = [defaults, "restitution of stop 1 is 1.8"];
    refused("\"r\"\n", "\"r + 1\"\n", "restitution", "stop[1].restitution", &words);
    refused(
        "= \"omega\"",
        "= \"omega - 3\"",
        "frequency = ",
        "system.frequency",
        &[defaults, "greater than 0"],
    );
    let second = |sign: i32, gap: &str| {
        format!("[[stop]]\nname = \"B\"\ndirection = [{sign}]\ngap = {gap}\nrestitution = 0\n[plane]")
    };
    let at = line("[plane]");
    let with_order = |text: String| {
        let text = example().replace("[plane]", &text).replace(ORDER, "");
        Family::parse(&text, "mine.toml").unwrap_err()
    };
    let overlap = with_order(second(-1, "\"-sigma - 0.5\""));
    assert_eq!((overlap.place.line, overlap.place.key.as_str()), (at + 3, "stop[2].gap"), "{overlap}");
    assert!(overlap.to_string().contains("overlap by 0.5 along their line:"), "{overlap}");
    let behind = with_order(second(2, "1"));
    assert_eq!((behind.place.line, behind.place.key.as_str()), (at + 2, "stop[2].direction"), "{behind}");
}

#[test]
fn stops_have_names_of_their_own() {
    let second = |name: &str| format!("{name}\ndirection = [-1]\ngap = 1\nrestitution = 0\n[plane]");
    let plane = line("[plane]");
    let refused_name = |name: &str, key: &str, line: usize, words: &str| {
        let error = broken("[plane]", &format!("[[stop]]\n{}", second(name)));
        assert_eq!((error.place.line, error.place.key.as_str()), (line, key), "{error}");
        assert!(error.to_string().contains(words), "{error}");
    };
    refused_name("name = \"A\"", "stop[2].name", plane + 1, "a stop above has it");
    refused_name("name = \"B\"\nalias = \"A\"", "stop[2].alias", plane + 2, "a stop above has it");
    refused_name("name = \"left stop\"", "stop[2].name", plane + 1, "blank");
    refused_name("name = \"B\"", "label_order", line(ORDER), "stop `B` is missing: write each of A, B once");
}

#[test]
fn label_orders_name_each_stop_once() {
    refused(ORDER, "label_order = [\"C\"]", ORDER, "label_order[1]", &["no stop `C`: write each of A once"]);
    refused(ORDER, "label_order = [\"A\", \"A\"]", ORDER, "label_order[2]", &["stop `A` is named twice"]);
    refused(ORDER, "label_order = \"A\"", ORDER, "label_order", &["this is a text"]);
}

#[test]
fn default_planes_have_two_sound_axes() {
    let x = "x = \"omega=1:4:400\"";
    let cases = [
        ("omega", "is not an axis: write NAME=FIRST:LAST:COUNT"),
        ("omega=1:4", "is not an axis"),
        ("omega=1:inf:4", "is not an axis"),
        ("omega=4:1:400", "FIRST must be less than LAST"),
        ("omega=1:4:1", "COUNT between 2 and 65536"),
        (
            "omga=1:4:400",
            "neither a parameter nor a component of the start: write one of omega, zeta, sigma, r",
        ),
        ("x2=1:4:400", "x1 to x1"),
        ("omega=0:4:400", "omega = 0 is out of range"),
    ];
    for (axis, words) in cases {
        refused(x, &format!("x = \"{axis}\""), x, "plane.x", &[axis, words]);
    }
    refused(x, "x = \"sigma=0:1:10\"", "y = \"sigma", "plane.y", &["as the other axis does"]);
    let start = example().replace(x, "x = \"v1=-1:1:10\"");
    assert!(Family::parse(&start, "mine.toml").is_ok());
}

#[test]
fn parameters_may_have_sections_of_their_own() {
    let text = example().replace(ZETA, "").replace("[system]", "[parameters.zeta]\ndefault = 0.5\n[system]");
    let family = Family::parse(&text, "mine.toml").unwrap();
    assert_eq!(family.about(family.parameter("zeta").unwrap()).default, 0.5);
    let error = Family::parse(&text.replace("default = 0.5", "about = \"a\""), "mine.toml").unwrap_err();
    assert_eq!((error.place.key.as_str(), error.place.line), ("parameters.zeta.default", line("[system]")));
}

/// Whatever is cut out of a file, it is read or refused at a line that it has.
#[test]
fn damaged_files_are_read_or_refused() {
    let mut refusals = 0;
    let mut read = |text: &str| {
        if let Err(error) = Family::parse(text, "mine.toml") {
            refusals += 1;
            assert!((1..=1 + text.matches('\n').count()).contains(&error.place.line), "{error}");
            assert!(error.to_string().starts_with(&format!("mine.toml:{}: ", error.place.line)), "{error}");
        }
    };
    for (at, letter) in example().char_indices() {
        read(&example()[..at]);
        read(&format!("{}{}", &example()[..at], &example()[at + letter.len_utf8()..]));
        read(&format!("{}\"{}", &example()[..at], &example()[at..]));
    }
    for text in BUILTIN.map(|family| family.text) {
        let lines: Vec<&str> = text.lines().collect();
        for cut in 0..lines.len() {
            read(&[&lines[..cut], &lines[cut + 1..]].concat().join("\n"));
        }
    }
    assert!(refusals > 1000, "{refusals}");
}
