//! Step lengths that shrink where steps fail and grow back.

/// Length of the next step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pace {
    /// s.
    pub next: f64,
}

impl Pace {
    /// Length of a step with `left` seconds to go, shared out so that the last is no sliver.
    pub(crate) fn length(&self, left: f64) -> f64 {
        if left <= self.next * (1.0 + 1e-9) {
            left
        } else if left < 2.0 * self.next {
            0.5 * left
        } else {
            self.next
        }
    }

    /// Takes note of a step of length `dt` accepted after so many cuts; `longest` is the length wished
    /// for. A step shortened only by the end of the run does not shorten the next.
    pub(crate) fn accepted(&mut self, dt: f64, cuts: usize, longest: f64) {
        self.next = match cuts {
            0 => (2.0 * self.next).min(longest),
            _ => dt,
        };
    }
}
