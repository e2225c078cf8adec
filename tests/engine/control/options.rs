//! Options of control methods as a library takes them.

use impact_atlas::control::{GivenOptions, METHODS, OptionValue, Scheme, Site};
use impact_atlas::model::Setting;
use impact_atlas::system::Family;

#[test]
fn options_of_other_methods_and_values_of_other_kinds_are_refused() {
    let site = Site::new(&Setting::defaults(Family::paper()), None).unwrap();
    let refusal = |method: &str, name: &'static str, value: OptionValue| {
        let method = METHODS.iter().find(|own| own.name == method).unwrap();
        let given = GivenOptions(vec![(name, value)]);
        Scheme::given(method, &given, &site).err().map(|why| why.to_string()).unwrap_or_default()
    };
    let (number, word) = (OptionValue::Number(0.1), OptionValue::Word("half".to_owned()));
    let numbers = OptionValue::Numbers(vec![0.1]);
    assert!(refusal("delay", "alpha", number.clone()).contains("--alpha has no effect on delay"));
    assert!(refusal("delay", "colour", word.clone()).contains("--colour has no effect"));
    assert!(refusal("delay", "gain", word.clone()).ends_with("give a number"));
    assert!(refusal("delay", "delay", number.clone()).ends_with("give a whole number"));
    assert!(refusal("delay", "gains", number.clone()).ends_with("give a list of numbers"));
    assert!(refusal("delay", "stop", number.clone()).ends_with("give a word"));
    assert!(refusal("delay", "sign", word).contains("give one of "));
    assert_eq!(refusal("delay", "gain", number.clone()), "");
    assert_eq!(refusal("sine", "target", numbers), "");
    assert!(refusal("delay", "target", number).contains("has no effect"), "it aims at nothing");
}
