//! Tuned mass dampers beside an absorber, against Runge and Kutta: nothing is shared with `vinesink::linear`.

use std::f64::consts::TAU;

use vinesink::alternatives::{Alternatives, Row, Which};
use vinesink::answer::{Answer, Asked, Decided};
use vinesink::case::Case;
use vinesink::dampers::{AtBound, Designing, SineLimits, best, for_band};
use vinesink::executor::Serial;
use vinesink::linear::{BandSystems, TunedMassDamper, bare_amplitude};

fn found(name: &str) -> (Case, Alternatives) {
    compared(name, std::fs::read_to_string(format!("cases/{name}.toml")).expect("a case"))
}

fn compared(name: &str, text: String) -> (Case, Alternatives) {
    let case = Case::parse(name, &text).expect("valid");
    let answer = Answer::of(&case, Asked::Decision, None, &Serial).expect("answered");
    let what = Decided { alternatives: true, ..Decided::NOTHING };
    let answer = answer.decided(&case, what, &Serial).expect("flown");
    (case, answer.alternatives.expect("compared"))
}

/// A structure with a damper in SI: displacement and velocity of both.
struct Rig {
    mass: f64,
    stiffness: f64,
    damping: f64,
    damper_mass: f64,
    damper_stiffness: f64,
    damper_damping: f64,
}

impl Rig {
    fn of(case: &Case, natural_frequency: f64, damper: &TunedMassDamper, drift: f64) -> Self {
        let scales = case.units();
        let (mass, system) = (scales.oscillator_mass, case.system());
        let omega = TAU * natural_frequency;
        let own = damper.tuning * omega;
        let damper_mass = system.mass_ratio() * mass;
        Self {
            mass,
            stiffness: mass * omega * omega * (1.0 + drift) * (1.0 + drift),
            damping: damper_mass * system.damping() * omega,
            damper_mass,
            damper_stiffness: damper_mass * own * own,
            damper_damping: 2.0 * damper.damping_ratio * damper_mass * own,
        }
    }

    fn rates(&self, [x, v, y, u]: [f64; 4], force: f64) -> [f64; 4] {
        let pull = self.damper_stiffness * (y - x) + self.damper_damping * (u - v);
        let acceleration = (force - self.stiffness * x - self.damping * v + pull) / self.mass;
        [v, acceleration, u, -pull / self.damper_mass]
    }

    /// A step of Runge and Kutta.
    fn step(&self, at: [f64; 4], time: f64, h: f64, force: &dyn Fn(f64) -> f64) -> [f64; 4] {
        let plus = |rates: [f64; 4], part: f64| {
            let mut sum = at;
            sum.iter_mut().zip(rates).for_each(|(one, rate)| *one += part * h * rate);
            sum
        };
        let a = self.rates(at, force(time));
        let b = self.rates(plus(a, 0.5), force(time + 0.5 * h));
        let c = self.rates(plus(b, 0.5), force(time + 0.5 * h));
        let d = self.rates(plus(c, 1.0), force(time + h));
        let mut next = at;
        for k in 0..4 {
            next[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
        }
        next
    }

    /// Largest displacement, stroke, velocity and acceleration once a steady force has been there for long.
    fn steady(&self, amplitude: f64, frequency: f64) -> [f64; 4] {
        let h = 1.0 / frequency / 400.0;
        let force = |time: f64| amplitude * libm::sin(TAU * frequency * time);
        let (mut at, mut largest) = ([0.0; 4], [0.0_f64; 4]);
        for k in 0..400 * 260 {
            at = self.step(at, f64::from(k) * h, h, &force);
            if k > 400 * 240 {
                let rates = self.rates(at, force(f64::from(k + 1) * h));
                let seen = [at[0], at[2] - at[0], at[1], rates[1]];
                largest.iter_mut().zip(seen).for_each(|(one, seen)| *one = one.max(seen.abs()));
            }
        }
        largest
    }

    /// When the amplitude of the structure stays below a level, with stops that the damper's mass hits or without.
    fn settles(&self, speed: f64, level: f64, natural: f64, stops: Option<(f64, f64)>) -> f64 {
        let h = 1.0 / natural / 4000.0;
        let omega = TAU * natural;
        let (mut at, mut last) = ([0.0, speed, 0.0, 0.0], 0.0);
        for k in 0..4000 * 80 {
            let mut next = self.step(at, 0.0, h, &|_| 0.0);
            if let Some((room, restitution)) = stops {
                let out = |at: [f64; 4]| {
                    (at[0] - at[2]).abs() > room && (at[0] - at[2]) * (at[1] - at[3]) > 0.0
                };
                if out(next) {
                    // A bisection of the step, an impact, and the rest of it.
                    let (mut inside, mut outside) = (0.0, h);
                    for _ in 0..60 {
                        let middle = 0.5 * (inside + outside);
                        if out(self.step(at, 0.0, middle, &|_| 0.0)) {
                            outside = middle
                        } else {
                            inside = middle
                        }
                    }
                    let mut there = self.step(at, 0.0, outside, &|_| 0.0);
                    let mu = self.damper_mass / self.mass;
                    let change = (1.0 + restitution) * (there[1] - there[3]) / (1.0 + mu);
                    there[1] -= mu * change;
                    there[3] += change;
                    next = self.step(there, 0.0, h - outside, &|_| 0.0);
                }
            }
            at = next;
            if libm::hypot(at[0], at[1] / omega) > level {
                last = f64::from(k + 1) * h;
            }
        }
        last
    }
}

fn close(found: f64, told: f64, within: f64, what: &str) {
    assert!((found / told - 1.0).abs() < within, "{what}: {found} by Runge and Kutta, {told} told");
}

/// The dampers of a band: peak and stroke at the worst of 120 frequencies, as it is and off by 10 %.
#[test]
#[ignore = "deep"]
fn dampers_along_a_band_are_those_of_runge_and_kutta() {
    let (case, found) = found("mast-mode-2");
    let worst = |row: &Row, drifts: &[f64]| {
        let damper = row.damper.expect("a damper");
        let mut largest = [0.0_f64; 2];
        for drift in drifts {
            let rig = Rig::of(&case, 6.894, &damper, *drift);
            for k in 0..=120 {
                let frequency = 5.86 + (7.583 - 5.86) * f64::from(k) / 120.0;
                let [x, stroke, ..] = rig.steady(14.07, frequency);
                largest = [largest[0].max(x), largest[1].max(stroke)];
            }
        }
        largest
    };
    for (which, drift) in
        [(Which::Damper, 0.0), (Which::DamperInEqualRoom, 0.0), (Which::Damper, 0.1)]
    {
        let row = found.row(which, drift).expect("a row");
        let drifts = if drift == 0.0 { vec![0.0] } else { vec![-drift, drift] };
        let [peak, stroke] = worst(row, &drifts);
        close(peak, row.worst[0], 0.01, "peak");
        close(stroke, row.stroke.expect("a stroke"), 0.01, "stroke");
    }
    let room = found.row(Which::DamperInEqualRoom, 0.0).expect("a row").stroke;
    assert!(room.expect("a stroke") < 2.7e-3 * 1.002, "{room:?}");
}

/// A narrow band has a damper with little damping and much stroke, far from the one that fits: no damper of a grid that stays
/// within the absorber's room is better by more than its steps leave, and the one that is told stays within.
#[test]
fn a_damper_in_the_absorbers_room_stays_within_it() {
    let text = std::fs::read_to_string("docs/src/cases/foot.toml").expect("a case");
    for clearance in [0.2, 1.0, 1.561, 2.5] {
        let (case, found) =
            compared("foot", text.replace("\"1 mm\"", &format!("\"{clearance} mm\"")));
        let row = found.row(Which::DamperInEqualRoom, 0.0).expect("a row");
        let stroke = 1e3 * row.stroke.expect("a damper");
        assert!(stroke <= clearance * (1.0 + 1e-5), "{clearance} mm: {stroke} mm");
        let system = case.system();
        let band = |tuning: f64, damping_ratio: f64| {
            let damper = TunedMassDamper { tuning, damping_ratio };
            let at = |k: u32| {
                let ratio = (11.6 + 0.8 * f64::from(k) / 40.0) / 12.0;
                let there = system.with_frequency_ratio(ratio).expect("valid");
                [damper.amplitude(&there), damper.stroke(&there)].map(|one| one * clearance)
            };
            (0..=40).map(at).fold([0.0_f64; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])])
        };
        let dampings = (0..=60).map(|k| libm::pow(10.0, -3.0 + 4.0 * f64::from(k) / 60.0));
        let grid = dampings
            .flat_map(|damping| (0..=60).map(move |k| (0.6 + 0.8 * f64::from(k) / 60.0, damping)));
        let fits =
            grid.map(|(tuning, damping)| band(tuning, damping)).filter(|one| one[1] <= clearance);
        let best = fits.map(|one| one[0]).fold(f64::INFINITY, f64::min);
        assert!(1e3 * row.worst[0] < 1.002 * best, "{clearance} mm: {row:?} against {best} mm");
    }
}

/// What the first criterion asks about is compared: velocity and acceleration are largest at other frequencies
/// than displacement.
#[test]
#[ignore = "deep"]
fn dampers_are_compared_by_what_is_asked() {
    let text = std::fs::read_to_string("cases/mast-mode-2.toml").expect("a case");
    let (before, _) = text.split_once("[criteria]").expect("criteria");
    for (key, limit, k, part) in [
        ("rms_velocity", "90 mm/s", 2, std::f64::consts::FRAC_1_SQRT_2),
        ("acceleration", "8 m/s2", 3, 1.0),
    ] {
        let text = format!("{before}[criteria]\n{key} = \"<= {limit}\"\n");
        let (case, found) = compared(key, text);
        let own = found.row(Which::Absorber, 0.0).expect("a row").worst;
        let judged = Answer::of(&case, Asked::Criteria, None, &Serial).expect("answered").judged;
        assert_eq!(Some(own[0]), judged[0].found, "{key}");
        // A structure alone: the largest of the closed form over its band, by hand.
        let (mass, natural, zeta, force) = (30.0, TAU * 6.894, 0.005, 14.07);
        let alone = |hertz: f64| {
            let omega = TAU * hertz;
            let (spring, loss) = (natural * natural - omega * omega, 2.0 * zeta * natural * omega);
            let amplitude = force / mass / libm::hypot(spring, loss);
            amplitude * [omega, omega * omega][k - 2] * part
        };
        let tried = (0..=200_000).map(|k| alone(5.86 + (7.583 - 5.86) * f64::from(k) / 200_000.0));
        let bare = found.row(Which::NoAbsorber, 0.0).expect("a row").worst[0];
        close(tried.fold(0.0, f64::max), bare, 1e-6, "the structure alone");
        let row = found.row(Which::Damper, 0.1).expect("a row");
        let mut largest = 0.0_f64;
        for drift in [-0.1, 0.1] {
            let rig = Rig::of(&case, 6.894, &row.damper.expect("a damper"), drift);
            for step in 0..=60 {
                let frequency = 5.86 + (7.583 - 5.86) * f64::from(step) / 60.0;
                largest = largest.max(part * rig.steady(14.07, frequency)[k]);
            }
        }
        close(largest, row.worst[0], 0.01, key);
    }
}

/// The same on the way through a resonance, from rest.
#[test]
#[ignore = "deep"]
fn dampers_of_a_sweep_are_compared_by_what_is_asked() {
    let text = std::fs::read_to_string("cases/sweep-fast.toml").expect("a case");
    let text =
        text.replace("\"base-displacement\"", "\"force\"").replace("\"0.25 mm\"", "\"2.9 N\"");
    for (key, limit, k) in [("peak_velocity", "0.2 m/s", 1), ("acceleration", "9 m/s2", 2)] {
        let (case, found) = compared(key, format!("{text}\n[criteria]\n{key} = \"<= {limit}\"\n"));
        let own = found.row(Which::Absorber, 0.0).expect("a row").worst;
        let judged = Answer::of(&case, Asked::Criteria, None, &Serial).expect("answered").judged;
        assert_eq!(Some(own[0]), judged[0].found, "{key}");
        let natural = f64::sqrt(11.47e3 / 4.168) / TAU;
        for (which, drift) in
            [(Which::Damper, 0.0), (Which::DamperInEqualRoom, 0.0), (Which::NoAbsorber, 0.0)]
        {
            let row = found.row(which, drift).expect("a row");
            let none = TunedMassDamper { tuning: 1e-9, damping_ratio: 0.0 };
            let rig = Rig::of(&case, natural, &row.damper.unwrap_or(none), drift);
            let force = |t: f64| 2.9 * libm::sin(TAU * (7.5 * t + 0.05 * t * t));
            let (mut at, mut largest) = ([0.0; 4], [0.0_f64; 3]);
            let h = 2.5e-4;
            for step in 0..60_000 {
                let time = f64::from(step) * h;
                at = rig.step(at, time, h, &force);
                let [velocity, acceleration, ..] = rig.rates(at, force(time + h));
                for (one, seen) in largest.iter_mut().zip([at[0], velocity, acceleration]) {
                    *one = one.max(seen.abs());
                }
            }
            // Stretches of a sweep hold its frequency: 1e-3 of the motion.
            close(largest[k], row.worst[0], 2e-3, key);
        }
    }
}

/// Those of a release: the time to the level, in unlimited and in equal room and between stops.
#[test]
#[ignore = "deep"]
fn dampers_of_a_release_are_those_of_runge_and_kutta() {
    let (case, found) = found("arm-empty");
    let level = 0.1 * 0.12 / (TAU * 8.0);
    for (which, stops) in [
        (Which::Damper, None),
        (Which::DamperInEqualRoom, None),
        (Which::DamperWithStops, Some((2.1e-3, 0.5))),
    ] {
        let row = found.row(which, 0.0).expect("a row");
        let rig = Rig::of(&case, 8.0, &row.damper.expect("a damper"), 0.0);
        close(rig.settles(0.12, level, 8.0, stops), row.worst[0], 0.01, "time to come to rest");
    }
    // No other damper is faster: those around it, by the same integration.
    let best = found.row(Which::Damper, 0.0).expect("a row");
    for (tuning, damping) in [(0.97, 1.0), (1.03, 1.0), (1.0, 0.85), (1.0, 1.15)] {
        let damper = best.damper.expect("a damper");
        let other = TunedMassDamper {
            tuning: tuning * damper.tuning,
            damping_ratio: damping * damper.damping_ratio,
        };
        let time = Rig::of(&case, 8.0, &other, 0.0).settles(0.12, level, 8.0, None);
        assert!(time > 0.999 * best.worst[0], "{tuning} {damping}: {time} {best:?}");
    }
}

/// Bands from half to twice the natural frequency, each 1 to 10 % wide to either side, of structures with dampers of 1 to 10 % of
/// their mass: the damper that is told is one that makes sense, and where the search ran to the end of that it says so; no
/// damper of a grid of them all is better by more than its steps leave.
#[test]
fn a_damper_of_any_band_is_one_that_makes_sense() {
    let mut at_bounds = Vec::new();
    for (k, centre) in [0.5, 0.7, 0.9, 0.95, 1.05, 1.2, 1.6, 2.0].into_iter().enumerate() {
        for (mass, wide) in [[(0.01, 0.1), (0.05, 0.01)][k % 2], (0.1, 0.05)] {
            let text = format!(
                "title = 't'\nsource = 's'\n[oscillator]\nmass = \"10 kg\"\nfrequency = \"10 Hz\"\n\
                 damping_ratio = {:?}\n[absorber]\nmass_ratio = {mass:?}\nclearance = \"1 mm\"\nrestitution = 0.6\n\
                 [excitation]\nkind = \"{}\"\namplitude = \"{}\"\nfrequency = \"{:?} Hz\"\n\
                 [band]\nfrom = \"{:?} Hz\"\nto = \"{:?} Hz\"\n",
                [0.003, 0.01, 0.05][k % 3],
                ["force", "base-displacement"][k % 2],
                ["20 N", "0.2 mm"][k % 2],
                10.0 * centre,
                10.0 * centre * (1.0 - wide),
                10.0 * centre * (1.0 + wide),
            );
            let case = Case::parse("case.toml", &text).expect("a case");
            let range = case.range();
            let along = BandSystems::of(&range);
            let worst = |damper: &TunedMassDamper| along.largest(|one| damper.amplitude(one)).1;
            let found = for_band(&along, &SineLimits::default());
            let at_bound = AtBound::of(found.tuning, found.damping_ratio);
            let what = format!("{text}{found:?} {at_bound:?}");
            assert!((0.1..=10.0).contains(&found.tuning), "{what}");
            assert!((1e-4..=10.0).contains(&found.damping_ratio), "{what}");
            let is_end = |at: f64, end: f64| (at / end - 1.0).abs() < 1e-3;
            let ends = [0.1, 10.0].iter().any(|end| is_end(found.tuning, *end))
                || [1e-4, 10.0].iter().any(|end| is_end(found.damping_ratio, *end));
            assert_eq!(at_bound.is_some(), ends, "{what}");
            let steps = |from: f64, to: f64, count: u32| {
                (0..=count)
                    .map(move |k| from * libm::pow(to / from, f64::from(k) / f64::from(count)))
            };
            let grid = steps(0.1, 10.0, 40).flat_map(|tuning| {
                steps(1e-3, 10.0, 8)
                    .map(move |damping_ratio| TunedMassDamper { tuning, damping_ratio })
            });
            let best = grid.map(|one| worst(&one)).fold(f64::INFINITY, f64::min);
            let bare = along.largest(bare_amplitude).1;
            println!("{centre} {mass} {wide}: {found:?} {} of {best}, alone {bare}", worst(&found));
            assert!(worst(&found) < 1.01 * best, "{what}: {best}");
            at_bounds.extend(at_bound);
        }
    }
    assert!(at_bounds.contains(&AtBound::Undamped), "{at_bounds:?}");
}

/// A structure with so much damping that a spring without damping cannot help it: the search for its frequency ran away to
/// 5e9 Hz, with a peak above that of the structure alone, and others to none. Within what makes sense there is one below.
#[test]
fn a_damper_without_a_medium_does_not_run_away() {
    for (damping, mass, [from, to]) in
        [(0.3, 0.1, [5.0, 15.0]), (0.1, 0.05, [11.0, 20.0]), (0.5, 0.1, [2.0, 30.0])]
    {
        let text = format!(
            "title = 't'\nsource = 's'\n[oscillator]\nmass = \"10 kg\"\nfrequency = \"10 Hz\"\ndamping_ratio = {damping:?}\n\
             [absorber]\nmass_ratio = {mass:?}\nclearance = \"10 mm\"\nrestitution = 0.6\n\
             [excitation]\nkind = \"force\"\namplitude = \"20 N\"\nfrequency = \"{from:?} Hz\"\n\
             [band]\nfrom = \"{from:?} Hz\"\nto = \"{to:?} Hz\"\n"
        );
        let case = Case::parse("case.toml", &text).expect("a case");
        let range = case.range();
        let along = BandSystems::of(&range);
        let worst = |damper: &TunedMassDamper| along.largest(|one| damper.amplitude(one)).1;
        let start = TunedMassDamper { damping_ratio: 0.002, ..TunedMassDamper::den_hartog(mass) };
        let how = Designing { damping: Some(0.002), ..Designing::USUAL };
        let found = best(start, how, worst);
        assert_eq!(found.damping_ratio, 0.002);
        assert!((0.1..=10.0).contains(&found.tuning), "{found:?}");
        let tunings = (0..=200).map(|k| libm::pow(10.0, f64::from(k) / 100.0 - 1.0));
        let tried = tunings.map(|tuning| worst(&TunedMassDamper { tuning, ..start }));
        let least = tried.fold(f64::INFINITY, f64::min);
        println!("{found:?}: {} of {least}", worst(&found));
        assert!(worst(&found) < 1.005 * least, "{found:?}: {} of {least}", worst(&found));
    }
}
