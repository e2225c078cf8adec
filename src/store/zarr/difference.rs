//! What differs between two configurations, in words.

use serde_json::Value;

/// The differences between what a store holds and what is asked for, one for each value; none if they are the same.
pub fn differences(stored: &Value, asked: &Value) -> Vec<String> {
    let mut found = Vec::new();
    compare("", stored, asked, &mut found);
    found
}

fn compare(name: &str, stored: &Value, asked: &Value, found: &mut Vec<String>) {
    // Numbers that are equal may be written in two ways, 1 and 1.0.
    let same_number = || stored.as_f64().is_some_and(|number| asked.as_f64() == Some(number));
    match (stored, asked) {
        _ if stored == asked || same_number() => {}
        (Value::Object(ours), Value::Object(theirs)) => {
            let mut keys: Vec<&String> = ours.keys().chain(theirs.keys()).collect();
            keys.sort_unstable();
            keys.dedup();
            for key in keys {
                let name = if name.is_empty() { key.clone() } else { format!("{name}.{key}") };
                let of = |map: &serde_json::Map<String, Value>| map.get(key).cloned().unwrap_or(Value::Null);
                compare(&name, &of(ours), &of(theirs), found);
            }
        }
        // The text of a family file is long; its hash differs too.
        _ if name == "system.text" => {}
        _ => found.push(format!("{name} is {} there and {} here", said(stored), said(asked))),
    }
}

fn said(value: &Value) -> String {
    match value {
        Value::Null => "not given".to_owned(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn every_value_that_differs_is_named() {
        let stored = json!({"x": {"count": 4, "first": 1}, "backend": "cpu", "certified": true});
        let asked = json!({"x": {"count": 5, "first": 1.0}, "backend": "gpu"});
        assert_eq!(
            differences(&stored, &asked),
            [
                "backend is cpu there and gpu here",
                "certified is true there and not given here",
                "x.count is 4 there and 5 here"
            ]
        );
        assert!(differences(&stored, &stored).is_empty());
    }
}
