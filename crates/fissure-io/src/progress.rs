//! A bar on the terminal that says how far a run is and how long it will take.

mod watch;

use std::fmt;
use std::io::IsTerminal;

use indicatif::{ProgressDrawTarget, ProgressStyle};

pub use watch::Progress;

/// indicatif counts in whole numbers; a simulation advances in seconds. This many parts make the whole.
const PARTS: u64 = 1_000_000;

/// Progress towards a total, on stderr; nothing at all where stderr is no terminal (a log file, a queue, a test).
///
/// Redrawing is limited by the clock, so it may be updated every step.
///
/// ```
/// use fissure_io::progress::ProgressBar;
///
/// let end = 4e-3; // s
/// let progress = ProgressBar::new(end, "bar");
/// for step in 1..=4 {
///     progress.update(1e-3 * f64::from(step), format_args!("step {step}, dt 1e-3 s"));
/// }
/// progress.finish();
/// ```
#[derive(Debug)]
pub struct ProgressBar {
    bar: indicatif::ProgressBar,
    total: f64,
}

impl ProgressBar {
    /// A bar towards `total`, a time in s or a count, behind a label.
    pub fn new(total: f64, label: &str) -> Self {
        let target = match std::io::stderr().is_terminal() {
            true => ProgressDrawTarget::stderr(),
            false => ProgressDrawTarget::hidden(),
        };
        Self::with_target(total, label, target)
    }

    /// Begins at `done` of the total, as after a restart: the time left is judged by what comes after.
    pub fn start_at(&self, done: f64) {
        self.bar.set_position(parts(done, self.total));
        self.bar.reset_eta();
    }

    /// Moves to `done` of the total and shows a message: `"step 812, dt 2.9e-7 s"`. Outside 0…total the bar stays at its
    /// end; without a total above zero it is full.
    pub fn update(&self, done: f64, message: impl fmt::Display) {
        self.bar.set_position(parts(done, self.total));
        // A hidden bar's message would be formatted for nobody.
        if !self.bar.is_hidden() {
            self.bar.set_message(message.to_string());
        }
    }

    /// Fills the bar and leaves it standing with the time the run took. Dropping without it leaves the bar where it
    /// stopped, as after a failure.
    pub fn finish(&self) {
        self.bar.finish();
    }

    fn with_target(total: f64, label: &str, target: ProgressDrawTarget) -> Self {
        let bar = indicatif::ProgressBar::with_draw_target(Some(PARTS), target)
            .with_prefix(label.to_owned());
        // The template is a constant that a test draws; a plain bar is better than a panic all the same.
        let style =
            ProgressStyle::with_template(TEMPLATE).unwrap_or_else(|_| ProgressStyle::default_bar());
        bar.set_style(style.progress_chars("━╸─"));
        Self { bar, total }
    }
}

const TEMPLATE: &str = "{prefix} {wide_bar:.cyan} {percent:>3} % {elapsed} left {eta}  {msg}";

/// The nearest number of parts; NaN counts as nothing done.
fn parts(done: f64, total: f64) -> u64 {
    if total > 0.0 {
        // The cast saturates and takes NaN to zero.
        ((done / total).clamp(0.0, 1.0) * PARTS as f64).round() as u64
    } else {
        PARTS
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use std::io;
    use std::sync::{Arc, Mutex};

    /// A terminal that keeps all that was ever drawn on it.
    #[derive(Debug, Clone, Default)]
    pub(in crate::progress) struct Terminal(Arc<Mutex<String>>);

    impl Terminal {
        pub(in crate::progress) fn drawn(&self) -> String {
            self.0.lock().unwrap().clone()
        }
    }

    impl indicatif::TermLike for Terminal {
        fn width(&self) -> u16 {
            100
        }
        fn move_cursor_up(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_down(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_right(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_left(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn write_line(&self, text: &str) -> io::Result<()> {
            self.write_str(text)
        }
        fn write_str(&self, text: &str) -> io::Result<()> {
            self.0.lock().unwrap().push_str(text);
            Ok(())
        }
        fn clear_line(&self) -> io::Result<()> {
            Ok(())
        }
        fn flush(&self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn the_bar_shows_label_share_and_message() {
        let terminal = Terminal::default();
        let target = ProgressDrawTarget::term_like(Box::new(terminal.clone()));
        let progress = ProgressBar::with_target(4e-3, "bar", target);
        progress.update(1e-3, "step 812, dt 2.9e-7 s");
        progress.bar.tick();
        let drawn = terminal.drawn();
        assert!(drawn.contains("bar ━"), "{drawn}");
        assert!(
            drawn.contains(" 25 % ")
                && drawn.contains("left")
                && drawn.contains("  step 812, dt 2.9e-7 s"),
            "{drawn}"
        );
        progress.finish();
        assert!(terminal.drawn().contains("100 %"), "{}", terminal.drawn());
    }

    #[test]
    fn nothing_is_drawn_where_nobody_looks() {
        let progress = ProgressBar::with_target(1.0, "bar", ProgressDrawTarget::hidden());
        struct Unformatted;
        impl fmt::Display for Unformatted {
            fn fmt(&self, _: &mut fmt::Formatter<'_>) -> fmt::Result {
                panic!("formatted for nobody")
            }
        }
        progress.update(0.5, Unformatted);
        progress.finish();
    }

    #[test]
    fn any_number_lands_on_the_bar() {
        assert_eq!(parts(0.5, 1.0), PARTS / 2);
        assert_eq!(
            (parts(2.0, 1.0), parts(-1.0, 1.0), parts(f64::NAN, 1.0)),
            (PARTS, 0, 0)
        );
        assert_eq!(
            (
                parts(0.0, 0.0),
                parts(0.0, f64::NAN),
                parts(1.0, f64::INFINITY)
            ),
            (PARTS, PARTS, 0)
        );
    }
}
