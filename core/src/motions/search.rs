//! The search: what can be solved for, then starts, each flown until it has settled; a chaotic transient is no motion.
//!
//! Every start is left alone for the [`SettlingTime`]; then it is on an orbit that was solved for, or is seen to repeat. A
//! repetition is proven by Newton's method; if the orbit does not attract, the start is pushed off it and flown on. What
//! wanders is flown on as well, for longer each time, while starts of its place still settle: until they have flown so many
//! windows together without one of them settling that a transient would have ended. What wanders still is measured.

use super::cluster::Cluster;
use super::flight::{StartFlight, StartOutcome, flown};
use super::identity::{KnownMotion, Proof};
use super::patience::{Missing, Patience, Thoroughness, busy};
use super::rest::Rest;
use super::settling::SettlingTime;
use super::watch::WindowSample;
use super::{Effort, Facts, Motion, MotionKind, Motions, Place, Reached, settling, solved};
use crate::executor::{Executor, map};
use crate::operation_count;
use crate::orbits::Orbit;
use crate::simulation::{Simulation, StartError, Stop};
use crate::system::{State, System};

/// Share of its steady amplitude within which a structure vibrates as if alone.
const STEADY: f64 = 1e-6;
/// How often the window is doubled of starts that still settle, that together are not one motion yet, or whose largest value
/// is hardly known.
const LONGEST: usize = 4;
/// Excitation periods over which starts are measured together at most, where a case asks for accuracy: a minute of a fast
/// machine.
const MOST_PERIODS: u64 = 512_000;
/// Measurements after which what looks like a motion that repeats, but for a modulation that stays, is one that wanders.
const FEWEST: usize = 3;
/// Excitation periods over which a start is measured at least, where it does not repeat; several times the slowest
/// modulation.
const RECOGNITION: u64 = 200;
/// Push off an orbit that does not attract, over the size of the motion: far above what a repetition leaves open.
const PUSH: f64 = 1e-3;
/// Starts that fly side by side: a few times the lanes of a batch.
const SIDE_BY_SIDE: usize = 256;

/// The long-term motions of each place, many places side by side.
///
/// ```
/// # use vinesink_core::system::{Cavity, Excitation, Parameters, System};
/// # let system = System::new(Parameters {
/// #     mass_ratio: 0.032 / 4.168, damping: 1.799, restitution: 0.6, frequency_ratio: 8.0 / 8.349,
/// #     forcing_per_clearance: 4.3417, excitation: Excitation::BaseDisplacement,
/// #     cavity: Cavity::IDEAL,
/// # })?;
/// use vinesink_core::executor::Serial;
/// use vinesink_core::motions::{Effort, Place, motions};
/// use vinesink_core::regimes::Regime;
///
/// let found = &motions(&[Place::new(&system, 8)], &Effort::over(100), &Serial)?[0];
/// let steady = found.main().expect("at least one");
/// assert_eq!((steady.regime(), steady.repeats_after()), (Regime::TwoSymmetric, Some(1)));
/// assert!((steady.facts().peak.value - 0.475).abs() < 1e-3); // over the clearance
/// assert_eq!(steady.reached().starts, 8);
/// // Where no wall reaches it, an absorber at rest is a motion as well.
/// assert!(found.rest().is_some() && found.len() == 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`StartError`] where a start is outside the cavity or not finite.
pub fn motions(
    places: &[Place],
    effort: &Effort,
    on: &dyn Executor,
) -> Result<Vec<Motions>, StartError> {
    let starts = |place: &Place| (place.starts.len() + place.further.len()).max(1);
    let each = places.iter().map(starts).max().unwrap_or(1);
    let groups: Vec<&[Place]> = places.chunks((SIDE_BY_SIDE / each).max(1)).collect();
    // One group counts its starts itself.
    let alone = groups.len() == 1;
    let what = if alone { "" } else { "looking for motions" };
    if alone {
        on.expect(
            places.iter().map(|place| (place.starts.len() + place.further.len()) as u64).sum(),
        );
    }
    let found = map(on, what, groups.len(), |k| {
        let advance = |starts: usize| {
            if alone {
                on.advance(starts as u64)
            }
        };
        let searched = || searched(groups[k], effort, on, &advance);
        let (found, cost) = operation_count::counted(searched);
        // Places that are searched together share the work.
        let cost = cost / groups[k].len().max(1) as u64;
        found.map(|found| found.into_iter().map(move |one| Motions { operations: cost, ..one }))
    });
    let mut all = Vec::with_capacity(places.len());
    for group in found {
        all.extend(group?);
    }
    Ok(all)
}

fn searched(
    places: &[Place],
    effort: &Effort,
    on: &dyn Executor,
    advance: &dyn Fn(usize),
) -> Result<Vec<Motions>, StartError> {
    let mut grounds: Vec<Ground> = Vec::with_capacity(places.len());
    let mut flights: Vec<StartFlight> = Vec::new();
    let mut of_place: Vec<usize> = Vec::new();
    let mut solved: Vec<KnownMotion> = Vec::new();
    for (number, place) in places.iter().enumerate() {
        // Places of one system, with a start each, follow one another.
        if number == 0 || places[number - 1].system != place.system {
            solved = solved::known(&place.system);
            let rest = solved::at_rest(&place.system);
            solved.extend(rest.map(|motion| KnownMotion::new(&place.system, motion)));
        }
        let mut ground = Ground::of(place, &solved, effort, of_place.len());
        for start in place.starts.iter().chain(&place.further) {
            let simulation = Simulation::new(&place.system, *start, 0.0)?;
            let left_out = ground.left_out;
            let index = of_place.len();
            flights.push(StartFlight { index, simulation, before: 0, left_out, window: 0 });
            of_place.push(number);
        }
        if settling::comes_to_rest(&place.system) {
            flights.truncate(flights.len() - ground.led.len());
            let rest = ground.at_rest(None);
            ground.led.fill(rest);
        }
        grounds.push(ground);
    }
    advance(of_place.len() - flights.len());
    while !flights.is_empty() {
        let known = |index: usize| grounds[of_place[index]].known.as_slice();
        let under_way = flights.len();
        let mut ended = Vec::with_capacity(under_way);
        while !flights.is_empty() {
            on.goes_on();
            let later = flights.split_off(SIDE_BY_SIDE.min(flights.len()));
            ended.extend(flown(flights, effort.most_impacts, &known));
            flights = later;
        }
        let mut open: Vec<Vec<StartFlight>> = places.iter().map(|_| Vec::new()).collect();
        for (flight, end) in ended {
            let place = of_place[flight.index];
            open[place].extend(grounds[place].taken(flight, end));
        }
        let further = grounds.iter_mut().zip(open).flat_map(|(ground, open)| ground.further(open));
        flights = further.collect();
        // In the order of their starts, whatever ended first.
        flights.sort_unstable_by_key(|flight| flight.index);
        advance(under_way - flights.len());
    }
    let all = grounds.into_iter().zip(places);
    let motions = |(ground, place): (Ground, &Place)| {
        let found = ground.motions(place.starts.len());
        let shaken = |motion: Motion| motion.shaken(&place.system, effort);
        Motions { all: found.all.into_iter().map(shaken).collect(), ..found }
    };
    Ok(all.map(motions).collect())
}

/// What is known of a place.
struct Ground {
    system: System,
    known: Vec<KnownMotion>,
    left_out: u64,
    /// The number of its first start among those of the search.
    first: usize,
    /// Whether starts creep along with the structure, so that each is measured where it is.
    creeps: bool,
    /// Which known motion each start led to.
    led: Vec<Option<usize>>,
    /// Starts that led there late, by their known motion.
    late: Vec<usize>,
    /// What the others were like when they were measured, if they still are.
    open: Vec<Option<WindowSample>>,
    /// Periods of a window, and the patience with all of them.
    periods: u64,
    patience: Patience,
    /// How often starts were measured, and over how many periods they were the last time.
    measured: usize,
    window: u64,
    accuracy: Option<[f64; 2]>,
    vague: f64,
    /// Whether more was asked for when the last round was over.
    impatient: bool,
    /// Excitation periods that each start was flown, impacts of its simulation so far, and those per period of the last flight.
    followed: Vec<u64>,
    impacts: Vec<u64>,
    busy: Vec<f64>,
}

impl Ground {
    fn of(place: &Place, solved: &[KnownMotion], effort: &Effort, first: usize) -> Self {
        let system = place.system;
        let mut known: Vec<KnownMotion> = Vec::new();
        for motion in &place.known {
            let mut motion = motion.clone();
            motion.reached = Reached { solved: motion.reached.solved, ..Reached::default() };
            known.push(KnownMotion::new(&system, motion));
        }
        let given = known.len();
        for one in solved {
            let is_given = |other: &KnownMotion| other.motion.kind.is_same(&one.motion.kind);
            if !known[..given].iter().any(is_given) {
                known.push(one.clone());
            }
        }
        let orbits: Vec<Orbit> =
            known.iter().filter_map(|one| one.motion.orbit().cloned()).collect();
        let count = place.starts.len() + place.further.len();
        let periods = effort.periods.max(1);
        let patience = Patience::with(Thoroughness {
            periods,
            starts: if place.in_full { effort.starts as usize } else { place.starts.len() },
            effort: effort.patience,
            place: place.patience,
            in_full: place.in_full,
        });
        Self {
            left_out: effort
                .discard
                .unwrap_or_else(|| SettlingTime::beside(&system, &orbits).periods),
            system,
            known,
            first,
            creeps: settling::creeps(&system),
            led: vec![None; count],
            late: Vec::new(),
            open: vec![None; count],
            periods,
            patience,
            measured: 0,
            window: 0,
            accuracy: effort.accuracy,
            vague: effort.vague,
            impatient: false,
            followed: vec![0; count],
            impacts: vec![0; count],
            busy: vec![0.0; count],
        }
    }

    /// Notes what became of a start; the flight if it is open.
    fn taken(&mut self, flight: StartFlight, end: StartOutcome) -> Option<StartFlight> {
        let start = flight.index - self.first;
        let flown = flight.before + flight.simulation.periods() - self.followed[start];
        self.followed[start] += flown;
        let impacts = flight.simulation.impacts() - self.impacts[start];
        self.impacts[start] += impacts;
        self.busy[start] = impacts as f64 / flown.max(1) as f64;
        self.open[start] = None;
        let first = self.patience.is_new() && self.measured == 0;
        let motion = match end {
            StartOutcome::Lost => None,
            StartOutcome::Rests(_) => self.at_rest(None),
            StartOutcome::On(known) => Some(known),
            StartOutcome::Open => {
                self.patience.flown(if first { 0 } else { flown });
                return Some(flight);
            }
            StartOutcome::Seen(sample) => match self.identified(&sample) {
                Identified::Known(known) => Some(known),
                Identified::Open => {
                    self.patience.flown(flown);
                    let goes_on = sample.stop == Stop::EndTime;
                    self.open[start] = Some(*sample);
                    return goes_on.then_some(flight);
                }
                Identified::Leaves => {
                    let before = self.followed[start];
                    self.impacts[start] = 0;
                    let simulation = pushed(&self.system, &sample.end);
                    self.open[start] = Some(*sample);
                    return simulation.map(|simulation| StartFlight {
                        simulation,
                        before,
                        ..flight
                    });
                }
            },
        };
        self.led[start] = motion;
        if !first {
            self.late.push(start);
            self.patience.settles();
        }
        None
    }

    /// The place of the motion at rest; one that was not solved for is what was seen.
    fn at_rest(&mut self, seen: Option<&WindowSample>) -> Option<usize> {
        let known = self.known.iter().position(|one| one.motion.rest().is_some());
        if known.is_some() {
            return known;
        }
        let (facts, state) = match seen {
            Some(sample) => (sample.facts, sample.end),
            None => {
                let steady = self.system.linear_response()?;
                (Facts::of_sine(steady.amplitude(), 0.0), steady.state(&self.system))
            }
        };
        let motion = Motion::resting(Rest::seen(&self.system, facts.peak.value), facts, state);
        self.known.push(KnownMotion::new(&self.system, motion));
        Some(self.known.len() - 1)
    }

    fn identified(&mut self, sample: &WindowSample) -> Identified {
        if sample.stop != Stop::EndTime {
            return Identified::Open;
        }
        // Without damping a free vibration beside it never fades; after almost plastic impacts the absorber drifts so
        // slowly that no wall is reached in any window, while the structure vibrates as if alone.
        let alone = || {
            let drifts = !self.system.cavity().moves_absorber();
            let steady = self.system.linear_response().map_or(f64::NAN, |at| at.amplitude());
            drifts && (sample.facts.peak.value - steady).abs() < STEADY * steady
        };
        let free =
            sample.evidence.impacts_per_period == 0.0 && (self.system.damping() == 0.0 || alone());
        if free || sample.evidence.periodicity.is_some_and(|found| found.impacts == 0) {
            return self.at_rest(Some(sample)).map_or(Identified::Open, Identified::Known);
        }
        let Some(found) = sample.evidence.periodicity else { return Identified::Open };
        if let Some(near) = self.known.iter().position(|one| one.distance(&sample.end) < 1.0) {
            return Identified::Known(near);
        }
        let (kind, sample) = match Proof::of(&self.system, sample, found) {
            Proof::Leaves => return Identified::Leaves,
            Proof::Open => return Identified::Open,
            Proof::Is(kind, sample) => (kind, sample),
        };
        if let Some(known) = self.known.iter().position(|one| one.motion.kind.is_same(&kind)) {
            return Identified::Known(known);
        }
        let Some(motion) = Motion::proven(&self.system, kind, Some(&sample)) else {
            return Identified::Open;
        };
        self.known.push(KnownMotion::new(&self.system, motion));
        Identified::Known(self.known.len() - 1)
    }

    /// Those that have not settled, with how far they go; none once they have shown what they are.
    fn further(&mut self, mut open: Vec<StartFlight>) -> Vec<StartFlight> {
        let beside = self.known.iter().any(|one| one.motion.rest().is_none());
        let Missing { windows, usual } = self.patience.missing(open.len(), beside);
        if open.is_empty() {
            self.impatient = false;
            return open;
        }
        let missing = if self.creeps { 0.0 } else { windows };
        // Where the rounds end before that it is what it is elsewhere.
        self.impatient = usual || self.creeps;
        let of = |flight: &StartFlight| {
            Some((flight.index, self.open[flight.index - self.first].clone()?))
        };
        let samples: Vec<(usize, WindowSample)> = open.iter().filter_map(of).collect();
        let measured = samples.len() == open.len();
        let count = open.len() as u64;
        let clusters =
            if measured { Cluster::all(samples.into_iter(), self.periods) } else { Vec::new() };
        let young = self.measured < FEWEST;
        let settles = clusters.len() > 1 || clusters.iter().any(|one| one.settles(young));
        let restless = settles && !self.creeps && self.measured <= LONGEST;
        let loose = |limits| clusters.iter().any(|one| !one.is_within(limits));
        let again = self.accuracy.is_some_and(loose) && self.window * count < MOST_PERIODS;
        let vague = self.measured <= LONGEST && clusters.iter().any(|one| one.is_vague(self.vague));
        let busiest = open.iter().map(|flight| self.busy[flight.index - self.first]);
        let busiest = busiest.fold(0.0, f64::max);
        let (left_out, window) = if self.patience.goes_on() && (missing > 0.0 || restless) {
            let [each, most] = self.patience.next(missing, open.len(), busiest);
            (if restless { most } else { each }, 0)
        } else if measured && !again && !vague {
            return Vec::new();
        } else {
            let shared = (self.periods / count).max(RECOGNITION).min(self.periods);
            let wanted = if self.window == 0 { shared } else { 2 * self.window };
            // What a case asks for takes what it takes.
            self.window = if again { wanted } else { settling::window(&self.system, wanted) };
            self.measured += busy(busiest) as usize;
            (0, self.window)
        };
        for flight in &mut open {
            (flight.left_out, flight.window) = (left_out, window);
        }
        open
    }

    /// The list, of which the first `counted` starts are counted.
    fn motions(self, counted: usize) -> Motions {
        let Self { mut known, mut led, late, open, impatient, followed, periods, .. } = self;
        let is_counted = |start: &usize| *start < counted;
        let samples = open.into_iter().enumerate().filter_map(|(start, one)| Some((start, one?)));
        let wanders = Cluster::all(samples, periods);
        let mut all: Vec<Motion> = Vec::new();
        for (index, one) in known.drain(..).enumerate() {
            let led = || (0..led.len()).filter(|start| led[*start] == Some(index));
            let late: Vec<usize> = led().filter(|start| late.contains(start)).collect();
            let last = late.iter().map(|start| followed[*start]).max();
            let first = led().map(|start| followed[start]).next();
            let reached = Reached {
                starts: led().filter(is_counted).count() as u32,
                late: late.iter().filter(|start| is_counted(start)).count() as u32,
                followed: last.or(first).unwrap_or_default(),
                solved: one.motion.reached.solved,
            };
            all.push(Motion { reached, ..one.motion });
        }
        for cluster in wanders {
            let known = all.iter_mut().enumerate().find(|(_, one)| {
                matches!(one.kind, MotionKind::Wanders) && cluster.is_like(&one.facts)
            });
            if let Some((index, known)) = known {
                known.reached.starts +=
                    cluster.members.iter().filter(|start| is_counted(start)).count() as u32;
                cluster.members.iter().for_each(|member| led[*member] = Some(index));
                continue;
            }
            let first = cluster.members.first().map(|start| followed[*start]);
            let reached = Reached {
                starts: cluster.members.iter().filter(|start| is_counted(start)).count() as u32,
                followed: first.unwrap_or_default(),
                ..Reached::default()
            };
            for member in &cluster.members {
                led[*member] = Some(all.len());
            }
            all.push(cluster.motion(reached, !impatient));
        }
        led.truncate(counted);
        Motions::ordered(all, counted as u32, led)
    }
}

enum Identified {
    /// It is the known motion with this index.
    Known(usize),
    /// It is about to leave where it is.
    Leaves,
    /// It wanders, as far as is seen.
    Open,
}

/// A trajectory beside a state, in no direction that a symmetry has.
fn pushed(system: &System, state: &State) -> Option<Simulation> {
    let push = PUSH * state.size().max(1.0);
    let gap = state.relative_displacement();
    // Inwards, as the absorber may be at a wall.
    let y = state.y + push * if gap < 0.0 { -1.0 } else { 1.0 };
    let beside = State { x_velocity: state.x_velocity + push, y, ..*state };
    Simulation::new(system, beside, 0.0).ok()
}

impl Motions {
    /// In the order of documents: by share, then peak.
    pub(super) fn ordered(all: Vec<Motion>, of_starts: u32, mut led: Vec<Option<usize>>) -> Self {
        let mut list = Self { all, of_starts, led: Vec::new(), operations: 0 };
        let mut order: Vec<usize> = (0..list.all.len()).collect();
        let key = |index: &usize| {
            let motion = &list.all[*index];
            (list.share(motion), motion.facts.peak.value)
        };
        order.sort_by(|a, b| {
            let (a, b) = (key(a), key(b));
            b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1))
        });
        let place = |old: usize| order.iter().position(|index| *index == old);
        led.iter_mut().for_each(|one| *one = one.and_then(place));
        let mut old: Vec<Option<Motion>> =
            std::mem::take(&mut list.all).into_iter().map(Some).collect();
        list.all = order.iter().filter_map(|index| old[*index].take()).collect();
        list.led = led;
        list
    }
}
