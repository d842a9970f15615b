//! How long starts that wander are flown on: a chaotic transient is no motion.
//!
//! Starts of a place that have not settled are flown on, for longer each time, until they have flown so many windows together
//! without one of them settling that a transient would have ended: [`BESIDE_ANOTHER`] where another motion is known to attract, and
//! [`ALONE`] for each of them. One that settles late begins the count anew.

/// Windows that the starts of a place fly together without one of them settling before what they do counts as a motion,
/// where another motion is known to attract: of a transient that lasts for all of these on average one in three is still
/// taken for a motion, of one that lasts a seventh of them one in a thousand.
const BESIDE_ANOTHER: f64 = 20.0;
/// The same for each start that has not settled, over the number of all starts, whatever else is known: a search with more
/// starts is a thorougher one.
const ALONE: f64 = 0.1;
/// The same over the windows that a start of the place has wandered for on average until it settled, where that decides: one
/// transient in twenty is then still taken for a motion.
const LIVES: f64 = 3.0;
/// Starts above which a search is no thorougher.
const MOST: usize = 32;
/// Quarters of a window that a start flies on at a time, at most: doubled each time, up to the last.
const FURTHER: [u64; 7] = [1, 2, 4, 8, 16, 32, 64];
/// How often starts fly on at most: one on a transient that lasts for 40 windows on average has then left it, but for one in
/// a thousand.
const ROUNDS: usize = 24;
/// So many times as many where a place is searched in full: of some on a transient the last outlast the usual ones.
const TO_THE_END: usize = 2;
/// Impacts per period above which starts fly on for fewer periods and less often: a bounce that hardly loses anything comes
/// to rest with ever more of them.
const BUSY: f64 = 16.0;

/// How many times as long as others starts with so many impacts per period take: at least 1.
pub(super) fn busy(impacts: f64) -> f64 {
    impacts.max(BUSY) / BUSY
}

/// How a place is searched.
#[derive(Debug, Clone, Copy)]
pub(super) struct Thoroughness {
    /// Excitation periods of a window.
    pub periods: u64,
    /// Starts of a search that is as thorough.
    pub starts: usize,
    /// Part of the usual patience that a case has, and that a place has beside others.
    pub effort: f64,
    /// See [`Self::effort`].
    pub place: f64,
    /// Whether a start is flown as long as where a case has one place, and longer where others of its place have settled late.
    pub in_full: bool,
}

/// The patience with the starts of a place.
#[derive(Debug)]
pub(super) struct Patience {
    periods: u64,
    alone: f64,
    share: f64,
    most_rounds: usize,
    in_full: bool,
    /// Of this round: whether a start has settled that wandered before, and periods that the others have flown.
    settled: bool,
    flown: u64,
    /// Windows without a start that settled, and all that starts have wandered for.
    quiet: f64,
    wandered: f64,
    /// Starts that have settled late.
    late: usize,
    /// How often starts were flown on.
    rounds: usize,
}

/// What is missing at the end of a round.
#[derive(Debug, Clone, Copy)]
pub(super) struct Missing {
    /// Windows that its starts would have to fly together.
    pub windows: f64,
    /// Whether that is so by the usual patience, whatever the life of transients.
    pub usual: bool,
}

impl Patience {
    /// With a place that is searched so.
    pub fn with(of: Thoroughness) -> Self {
        let Thoroughness { periods, starts, effort, place, in_full } = of;
        let rounds = if in_full { TO_THE_END * ROUNDS } else { ROUNDS };
        Self {
            periods,
            alone: ALONE * starts.min(MOST) as f64,
            share: effort * place,
            most_rounds: (effort * rounds as f64) as usize,
            in_full,
            settled: false,
            flown: 0,
            quiet: 0.0,
            wandered: 0.0,
            late: 0,
            rounds: 0,
        }
    }

    /// Notes periods that a start has wandered for.
    pub fn flown(&mut self, periods: u64) {
        self.flown += periods;
    }

    /// Notes that a start has settled that wandered before.
    pub fn settles(&mut self) {
        self.late += 1;
        self.settled = true;
    }

    /// What is missing at the end of a round with so many open starts, where another motion attracts or none is known.
    pub fn missing(&mut self, open: usize, beside: bool) -> Missing {
        let periods = self.periods as f64;
        self.wandered += self.flown as f64 / periods;
        self.quiet = if self.settled { 0.0 } else { self.quiet + self.flown as f64 / periods };
        (self.settled, self.flown) = (false, 0);
        let alone = self.alone * open as f64;
        let windows = if beside { alone.max(BESIDE_ANOTHER) } else { alone };
        // What starts have left is a transient, whose life is known.
        let life = self.wandered / self.late as f64;
        let lives = if self.in_full && self.late > 0 { LIVES * life } else { 0.0 };
        let missing = |windows: f64| self.share * windows - self.quiet;
        Missing { windows: missing(windows.max(lives)), usual: missing(windows) > 0.0 }
    }

    /// Whether starts may be flown on once more.
    pub fn goes_on(&self) -> bool {
        self.rounds < self.most_rounds
    }

    /// Notes a round in which so many starts with at most so many impacts per period fly on; excitation periods that each does where
    /// so many windows are missing, and at most.
    pub fn next(&mut self, windows: f64, open: usize, impacts: f64) -> [u64; 2] {
        let busy = busy(impacts);
        let most = FURTHER[self.rounds.min(FURTHER.len() - 1)] * self.periods / 4;
        let most = (most as f64 / busy) as u64;
        let each = (windows * self.periods as f64 / open as f64).ceil() as u64;
        self.rounds += busy as usize;
        [each.min(most), most]
    }

    /// Whether no start was flown on yet.
    pub fn is_new(&self) -> bool {
        self.rounds == 0
    }
}
