//! Progress of long work on standard error, with an estimate of the time left: a bar on a terminal, elsewhere
//! a line every four seconds.

use std::io::{self, IsTerminal as _};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, LazyLock, Mutex};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::output;

/// Work that ends sooner shows no bar.
const SHORT: Duration = Duration::from_secs(2);
/// Time between two looks of a bar.
const FRAME: Duration = Duration::from_millis(200);
/// Seconds between two lines, and a variable of the environment that sets another number for tests; with 0
/// every step has its line.
const BETWEEN_LINES: f64 = 4.0;
const INTERVAL: &str = "VINESINK_PROGRESS_SECONDS";

/// When this process began its first long work, and when it is to tell of any: several short ones in a row are
/// one long wait.
static PACE: LazyLock<(Instant, Mutex<Pace>)> =
    LazyLock::new(|| (Instant::now(), Mutex::new(Pace::every(interval()))));

/// Progress of one piece of work, which may be done by many threads. It ends when it is dropped.
pub struct Progress {
    shown: Arc<Shown>,
    ticking: Option<(Sender<()>, JoinHandle<()>)>,
}

struct Shown {
    work: ProgressWork,
    done: AtomicU64,
    begin: Instant,
    bar: Option<ProgressBar>,
}

/// What is done, and how much of it there is.
struct ProgressWork {
    name: String,
    size: Size,
}

enum Size {
    /// So many steps.
    Steps(u64),
    /// About so many seconds, where steps cannot be counted; estimated when it is first told.
    Seconds(Forecast),
}

type Forecast = LazyLock<f64, Box<dyn FnOnce() -> f64 + Send>>;

impl Progress {
    /// Of a number of steps, which [`Progress::advance`] counts.
    pub fn new(name: &str, steps: u64) -> Self {
        Self::begin(ProgressWork { name: name.to_owned(), size: Size::Steps(steps) })
    }

    /// Of work that cannot be counted and takes about so many seconds.
    pub fn estimated(name: &str, seconds: impl FnOnce() -> f64 + Send + 'static) -> Self {
        let estimate = Forecast::new(Box::new(seconds));
        Self::begin(ProgressWork { name: name.to_owned(), size: Size::Seconds(estimate) })
    }

    fn begin(work: ProgressWork) -> Self {
        let bar = io::stderr().is_terminal().then(|| hidden_bar(&work));
        let mut wait = match (&bar, PACE.1.lock()) {
            (Some(_), _) => FRAME,
            (None, pace) => pace.map_or(Duration::MAX, |pace| pace.interval),
        };
        let shown = Arc::new(Shown { work, done: AtomicU64::new(0), begin: Instant::now(), bar });
        if wait.is_zero() {
            shown.look();
        }
        let ticking = (!wait.is_zero()).then(|| {
            let (stop, stopped) = channel();
            let shown = Arc::clone(&shown);
            let ticker = thread::spawn(move || {
                while stopped.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                    wait = shown.look();
                }
            });
            (stop, ticker)
        });
        Self { shown, ticking }
    }

    /// Some steps more are done.
    pub fn advance(&self, steps: u64) {
        self.shown.done.fetch_add(steps, Ordering::Relaxed);
        if self.ticking.is_none() {
            self.shown.look();
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((stop, ticker)) = self.ticking.take() {
            // It ends as soon as nobody can tell it anything more.
            drop(stop);
            let _ = ticker.join();
        }
        if let Some(bar) = &self.shown.bar {
            bar.finish_and_clear();
        }
    }
}

impl Shown {
    /// Shows the state if it is time to; says after how long to look again.
    fn look(&self) -> Duration {
        let (start, pace) = &*PACE;
        let now = start.elapsed();
        let done = self.done.load(Ordering::Relaxed);
        let elapsed = self.begin.elapsed().as_secs_f64();
        if let Some(bar) = &self.bar {
            if now >= SHORT {
                if bar.is_hidden() {
                    bar.set_draw_target(ProgressDrawTarget::stderr());
                }
                bar.set_message(output::harmless(&self.work.line(done, elapsed)));
                bar.set_position(self.work.part(done, elapsed));
            }
            return FRAME;
        }
        // Nobody panics while holding it.
        let Ok(mut pace) = pace.lock() else { return Duration::MAX };
        if pace.due(now) {
            output::complain(&self.work.line(done, elapsed));
        }
        pace.next(now)
    }
}

/// Length of a bar in its own steps.
const BAR: u64 = 1000;

fn hidden_bar(work: &ProgressWork) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(BAR), ProgressDrawTarget::hidden());
    // The template is a constant; without it the bar keeps its default look.
    if let Ok(style) = ProgressStyle::with_template("[{bar:30}] {msg}") {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.set_message(work.name.clone());
    bar
}

/// The time between two lines that the environment asks for.
fn interval() -> Duration {
    let asked = std::env::var(INTERVAL).ok().and_then(|text| text.parse().ok());
    Duration::try_from_secs_f64(asked.unwrap_or(BETWEEN_LINES)).unwrap_or(Duration::MAX)
}

/// When lines are due. Times are since the first long work began.
struct Pace {
    interval: Duration,
    last: Duration,
}

impl Pace {
    fn every(interval: Duration) -> Self {
        Self { interval, last: Duration::ZERO }
    }

    /// Whether a line is due, which then is the last one.
    fn due(&mut self, now: Duration) -> bool {
        let due = now.saturating_sub(self.last) >= self.interval;
        if due {
            self.last = now;
        }
        due
    }

    /// Time until the next one.
    fn next(&self, now: Duration) -> Duration {
        self.interval.saturating_sub(now.saturating_sub(self.last))
    }
}

impl ProgressWork {
    /// How far it is after so many steps and seconds, in a line.
    fn line(&self, done: u64, elapsed: f64) -> String {
        let name = &self.name;
        match &self.size {
            // The number of steps is known about: a little more may be done than was announced.
            Size::Steps(steps) if done >= *steps => format!("{name}: {steps} of {steps}, ending"),
            Size::Steps(steps) if done == 0 => format!("{name}: 0 of {steps}"),
            Size::Steps(steps) => {
                let left = elapsed * (steps - done) as f64 / done as f64;
                format!("{name}: {done} of {steps}, about {} left", duration(left))
            }
            Size::Seconds(seconds) if elapsed < **seconds => {
                format!("{name}: about {} left", duration(**seconds - elapsed))
            }
            Size::Seconds(seconds) => {
                let (elapsed, expected) = (duration(elapsed), duration(**seconds));
                format!("{name}: {elapsed} so far, {expected} were expected")
            }
        }
    }

    /// The same as a part of [`BAR`].
    fn part(&self, done: u64, elapsed: f64) -> u64 {
        let part = match &self.size {
            Size::Steps(steps) => done as f64 / (*steps).max(1) as f64,
            Size::Seconds(seconds) => elapsed / **seconds,
        };
        (BAR as f64 * part.min(1.0)) as u64
    }
}

/// Seconds from which on nobody counts days: a thousand years.
const LONGEST: f64 = 3.2e10;

/// A time as a person says it.
pub fn duration(seconds: f64) -> String {
    match seconds {
        short if short < 120.0 => format!("{short:.0} s"),
        some if some < 7200.0 => format!("{:.0} min", some / 60.0),
        long if long < 172_800.0 => format!("{:.1} h", long / 3600.0),
        days if days < LONGEST => format!("{:.0} days", days / 86_400.0),
        _ => "thousands of years".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With the clock given: nothing before the interval is over, one line for each of them.
    #[test]
    fn lines_are_an_interval_apart() {
        let seconds = Duration::from_secs;
        let mut pace = Pace::every(seconds(10));
        let due: Vec<u64> = (0..=45).filter(|now| pace.due(seconds(*now))).collect();
        assert_eq!(due, [10, 20, 30, 40]);
        assert_eq!(pace.next(seconds(45)), seconds(5));
        // What comes late does not come twice.
        assert!(pace.due(seconds(71)) && !pace.due(seconds(72)) && pace.due(seconds(81)));
        let mut always = Pace::every(Duration::ZERO);
        assert!(always.due(seconds(0)) && always.due(seconds(0)));
    }

    #[test]
    fn a_line_says_how_far_and_how_long() {
        let counted = |steps| ProgressWork { name: "objective".into(), size: Size::Steps(steps) };
        // 120 in 10.7 s are 281 more in 25.06 s.
        assert_eq!(counted(401).line(120, 10.7), "objective: 120 of 401, about 25 s left");
        assert_eq!(counted(401).line(0, 10.0), "objective: 0 of 401");
        assert_eq!(counted(401).line(403, 30.0), "objective: 401 of 401, ending");
        assert_eq!(counted(1001).line(1, 60.0), "objective: 1 of 1001, about 16.7 h left");
        let seconds = Forecast::new(Box::new(|| 300.0));
        let estimated = ProgressWork { name: "band".into(), size: Size::Seconds(seconds) };
        assert_eq!(estimated.line(0, 60.0), "band: about 4 min left");
        assert_eq!(estimated.line(0, 310.0), "band: 5 min so far, 5 min were expected");
        assert_eq!([estimated.part(0, 60.0), estimated.part(0, 400.0)], [200, 1000]);
        assert_eq!([counted(8).part(2, 1.0), counted(0).part(3, 1.0)], [250, 1000]);
    }

    #[test]
    fn many_threads_count_together() {
        let progress = Progress::new("together", 8000);
        thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| (0..1000).for_each(|_| progress.advance(1)));
            }
        });
        assert_eq!(progress.shown.done.load(Ordering::Relaxed), 8000);
    }
}
