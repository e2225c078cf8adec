//! Loops unrolled in the text of a shader, for so many coordinates, contact normals and stops.
//!
//! A block between the lines `//: each normal` and `//: end` stands once for every normal, with `$k` as its number; so do
//! `each stop`, `each component` of a state (and `each further normal` or `component` after the first) and, with `$i` as the number and
//! `$c` as what selects the component, `each coordinate`. A block of `each pair of normals` stands once for every ordered pair,
//! with `$k` and `$l`. Terms of polynomials and Newton steps are unrolled too, with `$k` as the order: `each kick term` and `each back
//! term` from the highest but one down, `each slope term` and `each bend term` from the highest to the first and to the second.

use crate::dynamics::constants::NEWTON_STEPS;
use crate::model::{Real, System};

/// What a shader is written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shape {
    /// n, coordinates.
    pub coordinates: usize,
    /// Contact normals.
    pub normals: usize,
    /// Stops.
    pub stops: usize,
}

/// A block with a number in it.
fn numbered(block: &str, k: usize) -> String {
    block.replace("$k", &k.to_string())
}

impl Shape {
    /// That of a system.
    pub fn of(system: &System) -> Self {
        Shape {
            coordinates: system.coordinates(),
            normals: system.normals(),
            stops: system.label_order().len(),
        }
    }

    /// What selects component `i` of a vector: nothing where vectors are scalars.
    pub fn component(&self, i: usize) -> &'static str {
        if self.coordinates == 1 { "" } else { [".x", ".y", ".z", ".w"][i] }
    }

    /// The text with its blocks unrolled.
    ///
    /// # Panics
    /// If a block is not closed, or repeats over something that there is not.
    pub fn unrolled(&self, text: &str) -> String {
        let mut lines = text.lines();
        let mut unrolled = String::with_capacity(text.len());
        while let Some(line) = lines.next() {
            match line.trim().strip_prefix("//: each ") {
                None => {
                    unrolled.push_str(line);
                    unrolled.push('\n');
                }
                Some(what) => {
                    let block: Vec<&str> =
                        lines.by_ref().take_while(|line| line.trim() != "//: end").collect();
                    self.repeat(what, &block.join("\n"), &mut unrolled);
                }
            }
        }
        unrolled
    }

    fn repeat(&self, what: &str, block: &str, into: &mut String) {
        let mut push = |text: String| {
            into.push_str(&text);
            into.push('\n');
        };
        match what {
            "coordinate" => (0..self.coordinates).for_each(|i| {
                push(block.replace("$i", &i.to_string()).replace("$c", self.component(i)));
            }),
            "normal" => (0..self.normals).for_each(|k| push(numbered(block, k))),
            "further normal" => (1..self.normals).for_each(|k| push(numbered(block, k))),
            "component" => (0..2 * self.coordinates).for_each(|k| push(numbered(block, k))),
            "further component" => (1..2 * self.coordinates).for_each(|k| push(numbered(block, k))),
            "stop" => (0..self.stops).for_each(|k| push(numbered(block, k))),
            "pair of normals" => {
                for k in 0..self.normals {
                    for l in 0..self.normals {
                        push(block.replace("$k", &k.to_string()).replace("$l", &l.to_string()));
                    }
                }
            }
            // Horner's scheme, from the highest order below the last.
            "kick term" => (0..<f32 as Real>::KICK_ORDER).rev().for_each(|k| push(numbered(block, k))),
            "back term" => (0..<f32 as Real>::BACK_ORDER).rev().for_each(|k| push(numbered(block, k))),
            // From the highest order on, for what does not ask for the lowest, or the lowest two.
            "slope term" => (1..=<f32 as Real>::BACK_ORDER).rev().for_each(|k| push(numbered(block, k))),
            "bend term" => (2..=<f32 as Real>::BACK_ORDER).rev().for_each(|k| push(numbered(block, k))),
            "newton step" => (1..=NEWTON_STEPS).for_each(|k| push(numbered(block, k))),
            other => panic!("a shader repeats over `{other}`"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_stand_as_often_as_there_is_something() {
        let shape = Shape { coordinates: 3, normals: 2, stops: 1 };
        let text = "a\n  //: each normal\n  b$k\n  //: end\n//: each coordinate\nc$i$c\n//: end\nd\n";
        assert_eq!(shape.unrolled(text), "a\n  b0\n  b1\nc0.x\nc1.y\nc2.z\nd\n");
        let pairs = "//: each pair of normals\n$k$l\n//: end\n";
        assert_eq!(shape.unrolled(pairs), "00\n01\n10\n11\n");
        let scalar = Shape { coordinates: 1, normals: 1, stops: 1 };
        assert_eq!(scalar.unrolled("//: each coordinate\nx$c\n//: end\n"), "x\n");
    }
}
