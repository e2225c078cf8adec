//! The first time at which a polynomial becomes positive, on a grid with its maxima looked into.

/// Subintervals in which the polynomial is looked at.
const PARTS: u32 = 8;

fn value(c: &[f64], s: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

fn slope(c: &[f64], s: f64) -> f64 {
    c.iter().enumerate().skip(1).rev().fold(0.0, |sum, (k, c)| sum * s + k as f64 * c)
}

/// Between `low`, where `before` holds, and `high`, where it does not: the last number at which it does.
fn bisect(mut low: f64, mut high: f64, before: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if before(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// The first 0 < s ≤ `end` from which Σ cₖ sᵏ > 0; what is positive at 0 is not looked at before it is so further on.
pub fn first_positive(c: &[f64], end: f64) -> Option<f64> {
    for part in 0..PARTS {
        let [from, to] = [part, part + 1].map(|i| end * f64::from(i) / f64::from(PARTS));
        if value(c, to) > 0.0 {
            return Some(bisect(from, to, |s| value(c, s) <= 0.0));
        }
        if slope(c, from) > 0.0 && slope(c, to) < 0.0 {
            let top = bisect(from, to, |s| slope(c, s) > 0.0);
            if value(c, top) > 0.0 {
                return Some(bisect(from, top, |s| value(c, s) <= 0.0));
            }
        }
    }
    None
}
