//! Spans of time in words.

use std::time::Duration;

/// A span of time in the unit that it has at least two of, rounded.
pub fn words(span: Duration) -> String {
    let seconds = span.as_secs_f64();
    match seconds {
        _ if seconds < 120.0 => format!("{seconds:.0} s"),
        _ if seconds < 7200.0 => format!("{:.0} min", seconds / 60.0),
        _ if seconds < 172_800.0 => format!("{:.0} h", seconds / 3600.0),
        _ => format!("{:.0} days", seconds / 86_400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_are_short() {
        for (seconds, text) in [
            (0.2, "0 s"),
            (5.0, "5 s"),
            (119.0, "119 s"),
            (150.0, "2 min"),
            (10_000.0, "3 h"),
            (864_000.0, "10 days"),
        ] {
            assert_eq!(words(Duration::from_secs_f64(seconds)), text);
        }
    }
}
