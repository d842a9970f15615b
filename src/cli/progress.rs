//! Progress on a terminal; silence anywhere else.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar on standard error that shows itself on a terminal only and clears itself at the end.
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar with a name and a number of steps.
    pub fn new(name: &str, steps: u64) -> Self {
        let bar = ProgressBar::new(steps);
        // The template is a constant; without it the bar keeps its default look.
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:30}] {pos}/{len} {eta}") {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.set_message(name.to_owned());
        Self(bar)
    }

    /// The same for long work: with steps per second and the time left.
    pub fn with_rate(name: &str, steps: u64) -> Self {
        let progress = Self::new(name, steps);
        let template = "{msg} [{bar:30}] {human_pos}/{human_len}, {per_sec}, {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            progress.0.set_style(style.progress_chars("=> "));
        }
        progress
    }

    /// Some steps more are done.
    pub fn advance(&self, steps: u64) {
        self.0.inc(steps);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
