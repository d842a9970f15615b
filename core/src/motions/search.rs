//! The search: what can be solved for, then starts, each flown until it has settled; a chaotic transient is no motion.
//!
//! Every start is left alone until what it leaves has faded; then it is on an orbit that was solved for, or is seen to repeat. A
//! repetition is proven by Newton's method; if the orbit does not attract, the start is pushed off it and flown on. What
//! wanders is flown on as well, for longer each time, while starts of its place still settle: until they have flown so many
//! windows together without one of them settling that a transient would have ended. What wanders still is measured.

use super::cluster::Cluster;
use super::flight::{StartFlight, StartOutcome, flown};
use super::listed;
use super::model::{KnownMotion, LongTerm, Model, Proof, Sample};
use super::patience::{Missing, Patience, Thoroughness, busy};
use super::{Effort, Motion, Motions, Place, Reached};
use crate::executor::{Executor, map};
use crate::operation_count;
use crate::simulation::{StartError, Stop};
use crate::system::System;

/// How often the window is doubled of starts that still settle, that together are not one motion yet, or whose largest value
/// is hardly known.
const LONGEST: usize = 4;
/// Excitation periods over which starts are measured together at most, where a case asks for accuracy: a minute of a fast
/// machine.
const MOST_PERIODS: u64 = 512_000;
/// Measurements after which what looks like a motion that repeats, but for a modulation that stays, is one that wanders.
const FEWEST: usize = 3;
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
        let starts: Vec<Starts<System>> = groups[k].iter().map(Starts::of).collect();
        let searched = || -> Result<Vec<Motions>, StartError> {
            let found = searched(&starts, effort, on, &advance)?.into_iter().zip(groups[k]);
            Ok(found.map(|(found, place)| Motions::of(found, place, effort)).collect())
        };
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

/// What moves at a place, and where its motions begin: see [`Place`].
pub(super) struct Starts<M: Model> {
    pub model: M,
    pub counted: Vec<M::State>,
    pub further: Vec<M::State>,
    pub known: Vec<M::Motion>,
    pub patience: f64,
    pub in_full: bool,
}

impl Starts<System> {
    fn of(place: &Place) -> Self {
        let Place { system, starts, further, known, patience, in_full } = place.clone();
        Self { model: system, counted: starts, further, known, patience, in_full }
    }
}

/// The motions of a place: those that are known first, then those that were found.
pub(super) struct Found<M: Model> {
    pub all: Vec<M::Motion>,
    /// Which of them each counted start led to.
    pub led: Vec<Option<usize>>,
}

/// The motions of some places, whose starts fly side by side.
pub(super) fn searched<M: Model>(
    places: &[Starts<M>],
    effort: &Effort,
    on: &dyn Executor,
    advance: &dyn Fn(usize),
) -> Result<Vec<Found<M>>, M::StartError> {
    let mut grounds: Vec<Ground<M>> = Vec::with_capacity(places.len());
    let mut flights: Vec<StartFlight<M>> = Vec::new();
    let mut of_place: Vec<usize> = Vec::new();
    let mut solved: Vec<KnownMotion<M>> = Vec::new();
    for (number, place) in places.iter().enumerate() {
        // Places of one system, with a start each, follow one another.
        if number == 0 || places[number - 1].model != place.model {
            solved = place.model.solved();
        }
        let mut ground = Ground::of(place, &solved, effort, of_place.len());
        for start in place.counted.iter().chain(&place.further) {
            let flight = place.model.begin(start, 0.0)?;
            let left_out = ground.left_out;
            let index = of_place.len();
            flights.push(StartFlight {
                index,
                flight,
                before: 0,
                left_out,
                window: 0,
                whole: false,
            });
            of_place.push(number);
        }
        if place.model.comes_to_rest() {
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
        let mut open: Vec<Vec<StartFlight<M>>> = places.iter().map(|_| Vec::new()).collect();
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
    Ok(all.map(|(ground, place)| ground.motions(place.counted.len())).collect())
}

/// What is known of a place.
struct Ground<M: Model> {
    model: M,
    known: Vec<KnownMotion<M>>,
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
    open: Vec<Option<M::Sample>>,
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
    /// Impacts of starts that wandered, and at most.
    work: f64,
    most_work: f64,
}

impl<M: Model> Ground<M> {
    fn of(place: &Starts<M>, solved: &[KnownMotion<M>], effort: &Effort, first: usize) -> Self {
        let model = place.model.clone();
        let mut known: Vec<KnownMotion<M>> = Vec::new();
        for motion in &place.known {
            let solved = motion.reached().solved;
            let motion = motion.clone().with(Reached { solved, ..Reached::default() });
            known.push(KnownMotion::new(&model, motion));
        }
        let given = known.len();
        for one in solved {
            let is_given = |other: &KnownMotion<M>| other.motion.is_same(&one.motion);
            if !known[..given].iter().any(is_given) {
                known.push(one.clone());
            }
        }
        let count = place.counted.len() + place.further.len();
        let periods = effort.periods.max(1);
        let patience = Patience::with(Thoroughness {
            periods,
            starts: if place.in_full { effort.starts as usize } else { place.counted.len() }
                .min(M::MOST_STARTS),
            effort: effort.patience,
            place: place.patience,
            in_full: place.in_full,
        });
        Self {
            left_out: effort.discard.unwrap_or_else(|| model.settling(&known)),
            creeps: model.creeps(),
            most_work: model.most_impacts(place.patience),
            model,
            known,
            first,
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
            work: 0.0,
        }
    }

    /// Notes what became of a start; the flight if it is open.
    fn taken(&mut self, flight: StartFlight<M>, end: StartOutcome<M>) -> Option<StartFlight<M>> {
        let start = flight.index - self.first;
        let flown = flight.before + M::periods(&flight.flight) - self.followed[start];
        self.followed[start] += flown;
        let impacts = M::impacts(&flight.flight) - self.impacts[start];
        self.impacts[start] += impacts;
        self.busy[start] = impacts as f64 / flown.max(1) as f64;
        self.open[start] = None;
        let first = self.patience.is_new() && self.measured == 0;
        self.work += if first { 0.0 } else { impacts as f64 };
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
                // What it seemed to repeat is no motion that is known or proven.
                Identified::Open if !(flight.whole || sample.covers(flight.window)) => {
                    self.patience.flown(flown);
                    return Some(StartFlight { whole: true, ..flight });
                }
                Identified::Open => {
                    self.patience.flown(flown);
                    let goes_on = sample.stop() == Stop::EndTime;
                    self.open[start] = Some(*sample);
                    return goes_on.then_some(flight);
                }
                Identified::Leaves => {
                    let before = self.followed[start];
                    self.impacts[start] = 0;
                    let beside = self.model.pushed(M::end(&sample));
                    // It may leave again and again: what it does over a window stands for it then.
                    let stands = flight.whole || sample.covers(flight.window);
                    let whole = flight.whole || !stands;
                    self.open[start] = stands.then_some(*sample);
                    return beside.map(|beside| StartFlight {
                        flight: beside,
                        before,
                        whole,
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
    fn at_rest(&mut self, seen: Option<&M::Sample>) -> Option<usize> {
        let known = self.known.iter().position(|one| one.motion.rests());
        known.or_else(|| {
            let motion = self.model.resting(seen)?;
            Some(self.add(motion))
        })
    }

    /// The place of a new motion.
    fn add(&mut self, motion: M::Motion) -> usize {
        self.known.push(KnownMotion::new(&self.model, motion));
        self.known.len() - 1
    }

    fn identified(&mut self, sample: &M::Sample) -> Identified {
        if sample.stop() != Stop::EndTime {
            return Identified::Open;
        }
        if self.model.rests(sample) {
            return self.at_rest(Some(sample)).map_or(Identified::Open, Identified::Known);
        }
        if !sample.repeats() {
            return Identified::Open;
        }
        let end = M::end(sample);
        if let Some(near) = self.known.iter().position(|one| one.distance(end) < 1.0) {
            return Identified::Known(near);
        }
        let (kind, sample, is_on) = match self.model.proof(sample) {
            Proof::Leaves => return Identified::Leaves,
            Proof::Open => return Identified::Open,
            Proof::Is(kind, sample) => (kind, sample, true),
            Proof::Nears(kind, sample) => (kind, sample, false),
        };
        let known = self.known.iter().position(|one| M::is_kind(&one.motion, &kind));
        let known = known.or_else(|| {
            let motion = self.model.proven(kind, &sample)?;
            Some(self.add(motion))
        });
        known.filter(|_| is_on).map_or(Identified::Open, Identified::Known)
    }

    /// Those that have not settled, with how far they go; none once they have shown what they are.
    fn further(&mut self, mut open: Vec<StartFlight<M>>) -> Vec<StartFlight<M>> {
        let beside = self.known.iter().any(|one| !one.motion.rests());
        let Missing { windows, usual } = self.patience.missing(open.len(), beside);
        if open.is_empty() {
            self.impatient = false;
            return open;
        }
        let missing = if self.creeps { 0.0 } else { windows };
        // Where the rounds end before that it is what it is elsewhere.
        self.impatient = usual || self.creeps;
        let of = |flight: &StartFlight<M>| {
            Some((flight.index, self.open[flight.index - self.first].clone()?))
        };
        let samples: Vec<(usize, M::Sample)> = open.iter().filter_map(of).collect();
        let measured = samples.len() == open.len();
        let count = open.len() as u64;
        let clusters =
            if measured { Cluster::all(&self.model, samples, self.periods) } else { Vec::new() };
        let young = self.measured < FEWEST;
        let settles = clusters.len() > 1 || clusters.iter().any(|one| one.settles(young));
        let restless = settles && !self.creeps && self.measured <= LONGEST;
        let loose = |limits| clusters.iter().any(|one| !one.is_within(limits));
        let again = self.accuracy.is_some_and(loose) && self.window * count < MOST_PERIODS;
        let vague = self.measured <= LONGEST && clusters.iter().any(|one| one.is_vague(self.vague));
        let goes_on = self.patience.goes_on() && self.work <= self.most_work;
        let busiest = open.iter().map(|flight| self.busy[flight.index - self.first]);
        let busiest = busiest.fold(0.0, f64::max);
        let (left_out, window) = if goes_on && (missing > 0.0 || restless) {
            let [each, most] = self.patience.next(missing, open.len(), busiest);
            (if restless { most } else { each }, 0)
        } else if measured && !again && !vague {
            return Vec::new();
        } else {
            let shared = (self.periods / count).max(self.model.shortest_window()).min(self.periods);
            // One that only seemed to repeat makes up for it.
            let makes_up = !measured && open.iter().any(|flight| flight.whole);
            let wanted = match self.window {
                0 => shared,
                last if makes_up => last,
                last => 2 * last,
            };
            // What a case asks for takes what it takes.
            self.window = if again { wanted } else { self.model.window(wanted) };
            self.measured += busy(busiest) as usize;
            (0, self.window)
        };
        for flight in &mut open {
            (flight.left_out, flight.window) = (left_out, window);
            flight.whole &= window > 0;
        }
        open
    }

    /// The list, of which the first `counted` starts are counted.
    fn motions(self, counted: usize) -> Found<M> {
        let Self { model, known, mut led, late, open, impatient, followed, periods, .. } = self;
        let is_counted = |start: &usize| *start < counted;
        let samples = open.into_iter().enumerate().filter_map(|(start, one)| Some((start, one?)));
        let wanders = Cluster::all(&model, samples.collect(), periods);
        let mut all: Vec<M::Motion> = Vec::new();
        for (index, one) in known.into_iter().enumerate() {
            let led = || (0..led.len()).filter(|start| led[*start] == Some(index));
            let late: Vec<usize> = led().filter(|start| late.contains(start)).collect();
            let last = late.iter().map(|start| followed[*start]).max();
            let first = led().map(|start| followed[start]).next();
            let reached = Reached {
                starts: led().filter(is_counted).count() as u32,
                late: late.iter().filter(|start| is_counted(start)).count() as u32,
                followed: last.or(first).unwrap_or_default(),
                solved: one.motion.reached().solved,
            };
            all.push(one.motion.with(reached));
        }
        for cluster in wanders {
            let starts = cluster.members.iter().filter(|start| is_counted(start)).count() as u32;
            let is_known = |one: &M::Motion| one.wanders() && cluster.is_like(&one.averages());
            let index = all.iter().position(is_known).unwrap_or(all.len());
            cluster.members.iter().for_each(|member| led[*member] = Some(index));
            if let Some(known) = all.get_mut(index) {
                let reached = known.reached();
                let starts = reached.starts + starts;
                *known = known.clone().with(Reached { starts, ..reached });
                continue;
            }
            let first = cluster.members.first().map(|start| followed[*start]);
            let followed = first.unwrap_or_default();
            let reached = Reached { starts, followed, ..Reached::default() };
            all.push(cluster.motion(reached, !impatient));
        }
        led.truncate(counted);
        Found { all, led }
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

impl Motions {
    /// What was found at a place.
    fn of(found: Found<System>, place: &Place, effort: &Effort) -> Self {
        let found = Self::ordered(found.all, place.starts.len() as u32, found.led);
        let shaken = |motion: Motion| motion.shaken(&place.system, effort);
        Self { all: found.all.into_iter().map(shaken).collect(), ..found }
    }

    /// In the order of documents: by share, then peak.
    pub(super) fn ordered(all: Vec<Motion>, of_starts: u32, mut led: Vec<Option<usize>>) -> Self {
        let mut list = Self { all, of_starts, led: Vec::new(), operations: 0 };
        let mut order: Vec<usize> = (0..list.all.len()).collect();
        let key = |index: &usize| {
            let motion = &list.all[*index];
            (list.share(motion), motion.facts.peak.value)
        };
        order.sort_by(|a, b| listed::order(key(a), key(b)));
        let place = |old: usize| order.iter().position(|index| *index == old);
        led.iter_mut().for_each(|one| *one = one.and_then(place));
        let mut old: Vec<Option<Motion>> =
            std::mem::take(&mut list.all).into_iter().map(Some).collect();
        list.all = order.iter().filter_map(|index| old[*index].take()).collect();
        list.led = led;
        list
    }
}
