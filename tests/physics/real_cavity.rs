//! The reference in 77 digits with gravity along the cavity, friction in it and two restitutions: against motions
//! worked out by hand, against the energy balance, and against Coulomb's law stepped through time.

use vinesink::system::{Cavity, Excitation, Parameters, State, System};
use vinesink_evidence::reference::real::{BITS, ROUND};
use vinesink_evidence::reference::{Event, Reference, real::Decimal};

/// So light an absorber that 77 digits do not show what it does to the oscillator beyond the 60th.
const LIGHT: f64 = 1e-60;
/// What 77 digits lose to a light absorber, and to the 1e-40 at which chattering ends.
const DIGITS: f64 = 1e-55;
/// Events that no motion here has.
const MOST: usize = 1000;

/// Gravity along the cavity, friction, restitutions at `x - y = +b` and `-b`.
fn cavity(a: f64, f: f64, [plus, minus]: [f64; 2]) -> (Cavity, f64) {
    let cavity =
        Cavity { gravity_along: a, friction_acceleration: f, restitution_difference: plus - minus };
    (cavity, 0.5 * (plus + minus))
}

/// Without damping; nothing drives it unless `forcing` does.
fn system(mass_ratio: f64, (cavity, restitution): (Cavity, f64), forcing: f64) -> System {
    System::new(Parameters {
        mass_ratio,
        damping: 0.0,
        restitution,
        frequency_ratio: 0.5,
        forcing_per_clearance: forcing,
        excitation: Excitation::Force,
        cavity,
    })
    .expect("valid")
}

/// An oscillator at rest, an absorber at `y` with a velocity.
fn absorber(y: f64, y_velocity: f64) -> State {
    State { y, y_velocity, ..State::AT_REST }
}

fn root(number: &Decimal) -> Decimal {
    Decimal(number.0.sqrt(BITS, ROUND))
}

/// Quotient of two numbers.
fn over(above: f64, below: f64) -> Decimal {
    &Decimal::of(above) / &Decimal::of(below)
}

fn same(found: &Decimal, expected: &Decimal) {
    let error = (found - expected).to_f64().abs();
    assert!(error < DIGITS, "{} for {}: {error:e}", found.to_f64(), expected.to_f64());
}

/// To the last digit but one of a floating-point number.
fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 4e-16 * (1.0 + expected.abs()), "{found} for {expected}");
}

#[test]
fn a_sliding_absorber_stops_after_its_stopping_distance_and_stays() {
    let (f, u) = (0.05, 0.25);
    for sign in [1.0, -1.0] {
        let resting = system(LIGHT, cavity(0.0, f, [0.5; 2]), 0.0);
        let mut reference = Reference::new(&resting, absorber(0.0, sign * u), 0.0);
        let event = reference.next(100.0);
        assert!(matches!(event, Some(Event::Stick { wall: None, .. })), "{event:?}");
        let [time, _, _, y, velocity] = reference.moment();
        same(&time, &over(u, f));
        same(&y, &over(sign * 0.5 * u * u, f));
        same(&velocity, &Decimal::of(0.0));
        assert!(reference.rests());
        assert_eq!(reference.next(100.0), None);
    }
}

/// Upwards it is slowed by `a + f`; where `a > f` it comes back with `a - f`.
#[test]
fn an_absorber_slides_back_where_the_incline_is_steeper_than_its_friction() {
    let (a, f, u) = (0.25, 0.125, 0.5);
    let steep = system(LIGHT, cavity(a, f, [0.5; 2]), 0.0);
    let mut reference = Reference::new(&steep, absorber(0.5, -u), 0.0);
    let Some(Event::Reversal { tau, x }) = reference.next(100.0) else { panic!() };
    let (stop, way) = (over(u, a + f), &over(0.5 * u * u, a + f) - &Decimal::of(0.5));
    close(tau, u / (a + f));
    close(x, 0.0);
    same(&reference.moment()[0], &stop);
    same(&reference.moment()[3], &-&way);
    // To y = 1 from rest.
    let fall = &Decimal::of(1.0) + &way;
    let event = reference.next(100.0);
    assert!(matches!(event, Some(Event::Impact { side: -1.0, sticks: false, .. })), "{event:?}");
    let [time, _, _, y, after] = reference.moment();
    same(&time, &(&stop + &root(&(&fall / &over(a - f, 2.0)))));
    same(&y, &Decimal::of(1.0));
    same(&after, &-&(&Decimal::of(0.5) * &root(&(&fall * &Decimal::of(2.0 * (a - f))))));

    let gentle = system(LIGHT, cavity(0.125, 0.25, [0.5; 2]), 0.0);
    let mut reference = Reference::new(&gentle, absorber(0.5, -u), 0.0);
    let event = reference.next(100.0);
    assert!(matches!(event, Some(Event::Stick { wall: None, .. })), "{event:?}");
    same(&reference.moment()[0], &over(u, a + f));
    assert_eq!(reference.next(100.0), None);
}

/// Each excursion takes `u/(a+f)` out and `u k/(a-f)` back, `k^2 = (a-f)/(a+f)`, and ends with `k u`: what friction
/// leaves adds to the restitution, so that even elastic impacts crowd in.
#[test]
fn on_an_incline_chattering_ends_at_the_sum_of_its_series() {
    let (a, f) = (0.7_f64, 0.2);
    for r in [0.5, 1.0, 0.0] {
        let steep = system(LIGHT, cavity(a, f, [0.3, r]), 0.0);
        let mut reference = Reference::new(&steep, State::AT_REST, 0.0);
        let (mut impacts, mut reversals) = (0, 0);
        let end = loop {
            assert!(reversals < MOST);
            match reference.next(100.0) {
                Some(Event::Impact { tau, sticks: true, .. }) => break tau,
                Some(Event::Impact { side: -1.0, .. }) => impacts += 1,
                Some(Event::Reversal { .. }) => reversals += 1,
                event => panic!("{event:?}"),
            }
        };
        let k = libm::sqrt((a - f) / (a + f));
        let (fall, u) = (libm::sqrt(2.0 / (a - f)), r * libm::sqrt(2.0 * (a - f)));
        let expected = fall + u * (1.0 / (a + f) + k / (a - f)) / (1.0 - r * k);
        // The times of a hundred excursions are added up exactly, the sum is rounded a few times.
        assert!((end - expected).abs() < 1e-14, "r = {r}: {end} for {expected}");
        assert_eq!(impacts, reversals);
        assert_eq!(r == 0.0, impacts == 0);
        assert_eq!(reference.next(100.0), None);
    }
}

/// On the level friction stops what an impact throws back within the cavity, however near the wall; without
/// restitution it stays at the wall, and where its way ends at the wall as well.
#[test]
fn on_the_level_an_absorber_stops_next_to_the_wall() {
    let (f, u, r) = (0.125, 0.75, 1.0 / 1024.0);
    let level = system(LIGHT, cavity(0.0, f, [0.5, r]), 0.0);
    let mut reference = Reference::new(&level, absorber(0.0, u), 0.0);
    let event = reference.next(100.0);
    assert!(matches!(event, Some(Event::Impact { side: -1.0, sticks: false, .. })), "{event:?}");
    let event = reference.next(100.0);
    assert!(matches!(event, Some(Event::Stick { wall: None, .. })), "{event:?}");
    let thrown = Decimal::of(r * r * (u * u - 2.0 * f));
    let gap = &Decimal::of(1.0) - &reference.moment()[3];
    same(&gap, &(&thrown / &Decimal::of(2.0 * f)));
    assert_eq!(reference.next(100.0), None);

    let plastic = system(LIGHT, cavity(0.0, f, [0.5, 0.0]), 0.0);
    let mut reference = Reference::new(&plastic, absorber(0.0, u), 0.0);
    let event = reference.next(100.0);
    assert!(matches!(event, Some(Event::Impact { sticks: true, .. })), "{event:?}");
    assert_eq!(reference.next(100.0), None);

    // u^2 = 2 f ends at the wall. So does a way up an incline, from which it comes back if steep.
    for (a, f, sign, comes_back) in
        [(0.0, 0.125, 1.0, false), (0.03125, 0.09375, -1.0, false), (0.09375, 0.03125, -1.0, true)]
    {
        let level = system(LIGHT, cavity(a, f, [0.5; 2]), 0.0);
        let mut reference = Reference::new(&level, absorber(0.0, sign * 0.5), 0.0);
        match reference.next(100.0) {
            Some(Event::Stick { wall, .. }) if !comes_back => assert_eq!(wall, Some(-sign)),
            Some(Event::Reversal { tau, .. }) if comes_back => close(tau, 4.0),
            event => panic!("{event:?}"),
        }
    }
    // Short of it by 1e-33, and too far by as much, within a time of 1e-16.
    let level = system(LIGHT, cavity(0.0, 0.125, [0.5; 2]), 0.0);
    let event = Reference::new(&level, absorber(-1e-33, 0.5), 0.0).next(100.0);
    assert!(matches!(event, Some(Event::Stick { wall: None, .. })), "{event:?}");
    let event = Reference::new(&level, absorber(1e-33, 0.5), 0.0).next(100.0);
    assert!(matches!(event, Some(Event::Impact { sticks: false, .. })), "{event:?}");
}

/// At rest the oscillator's spring pulls by `-x`; of the pair's, friction carries the share `1/(1 + eps)`.
#[test]
fn at_rest_friction_holds_up_to_its_share_of_the_force() {
    let level = system(0.5, cavity(0.0, 0.3, [0.5; 2]), 0.0);
    for (x, held) in [(0.44, true), (-0.44, true), (0.46, false), (-0.46, false)] {
        let start = State { x, y: x, ..State::AT_REST };
        let mut reference = Reference::new(&level, start, 0.0);
        assert_eq!((reference.rests(), reference.next(10.0).is_none()), (held, held), "{x}");
    }
}

/// The pair swings about `eps a` with the mass `1 + eps`; what holds the absorber is its acceleration less `a`.
#[test]
fn friction_holds_the_absorber_until_the_pair_accelerates_too_much() {
    let (eps, a, f, v) = (0.25, 0.125, 0.3, 2.0);
    let total = libm::sqrt(1.0 + eps);
    let x = eps * a;
    // (x - y at the start, what pulls when it is released): at `x - y = +b` the wall pushes the other way.
    for (gap, pull) in [(0.3, -f), (1.0, -f), (-1.0, f)] {
        let level = system(eps, cavity(a, f, [0.5; 2]), 0.0);
        let start = State { x, x_velocity: v, y: x - gap, y_velocity: v };
        let mut reference = Reference::new(&level, start, 0.0);
        let Some(Event::Release { tau, x: there }) = reference.next(100.0) else { panic!() };
        // -v sin / sqrt(1 + eps) - a is the pull.
        let sine = -(pull + a) * total / v;
        let angle = libm::asin(sine);
        let angle = if gap < 0.0 { std::f64::consts::PI - angle } else { angle };
        close(tau, total * angle);
        close(there, x + v * total * sine);
        let [.., x_velocity, _, y_velocity] = reference.moment().map(|part| part.to_f64());
        close(x_velocity, v * libm::cos(angle));
        assert_eq!(x_velocity, y_velocity);
        // It gets away from there.
        let next = reference.next(100.0);
        assert!(!matches!(next, Some(Event::Reversal { tau: again, .. }) if again - tau < 0.1));
    }
}

/// A driven pair on its steady motion `x = X sin(Omega tau)`, `X = eps gamma/(1 - (1 + eps) Omega^2)`.
#[test]
fn friction_holds_a_driven_absorber_up_to_the_same_force() {
    let (eps, f, gamma, omega) = (0.25, 0.3, 6.0, 0.5);
    let amplitude = eps * gamma / (1.0 - (1.0 + eps) * omega * omega);
    let level = system(eps, cavity(0.0, f, [0.5; 2]), gamma);
    let x_velocity = amplitude * omega;
    let start = State { x_velocity, y_velocity: x_velocity, ..State::AT_REST };
    let mut reference = Reference::new(&level, start, 0.0);
    let Some(Event::Release { tau, x }) = reference.next(100.0) else { panic!() };
    let sine = f / (omega * omega * amplitude);
    close(tau, libm::asin(sine) / omega);
    close(x, amplitude * sine);
}

/// Nothing drives or damps: `x'^2/2 + x^2/2 + eps y'^2/2 - eps a y` falls by `eps f` times the way slid and by
/// what impacts take, stretch by stretch.
#[test]
fn energy_goes_where_friction_and_impacts_take_it() {
    let (mut slid, mut struck) = (0, 0);
    for (k, (eps, a, f, r)) in
        [(0.3, 0.1, 0.05, [0.75, 0.5]), (0.05, -0.4, 0.2, [1.0, 0.25]), (0.5, 0.0, 0.4, [0.5; 2])]
            .into_iter()
            .enumerate()
    {
        let bodies = system(eps, cavity(a, f, r), 0.0);
        let start = State { x: 2.0, x_velocity: -0.5, y: 1.5 + 0.1 * k as f64, y_velocity: 1.0 };
        let mut reference = Reference::new(&bodies, start, 0.0);
        let half = Decimal::of(0.5);
        let eps = Decimal::of(eps);
        let stored = |[_, x, v, y, u]: &[Decimal; 5]| {
            let oscillator = &(v * v) + &(x * x);
            let absorber = &(&(u * u) * &half) - &(&Decimal::of(a) * y);
            &(&oscillator * &half) + &(&eps * &absorber)
        };
        let mut before = reference.moment();
        for _ in 0..MOST {
            let Some(event) = reference.next(60.0) else { break };
            let after = reference.moment();
            let way = (&(&after[1] - &after[3]) - &(&before[1] - &before[3])).abs();
            let mut taken = &(&eps * &Decimal::of(f)) * &way;
            // What the end of chattering takes beyond its impact is 1e-40 wide.
            let mut allowed = 1e-70;
            if let Event::Impact { side, sticks, loss, .. } = event {
                let r = Decimal::of(if side > 0.0 { r[0] } else { r[1] });
                let approach = &(&after[2] - &after[4]) / &r;
                let total = &Decimal::of(2.0) * &(&Decimal::of(1.0) + &eps);
                let kept = &Decimal::of(1.0) - &(&r * &r);
                let lost = &(&(&eps * &kept) * &(&approach * &approach)) / &total;
                assert!(sticks || (loss - lost.to_f64()).abs() <= 1e-15 * loss, "{event:?}");
                taken = &taken + &lost;
                allowed = if sticks { 1e-38 } else { 1e-60 };
                struck += 1;
            } else {
                slid += 1;
            }
            let open = (&(&stored(&before) - &stored(&after)) - &taken).to_f64();
            assert!(open.abs() < allowed, "{event:?} leaves {open:e}");
            before = after;
        }
    }
    assert!(slid > 30 && struck > 60, "{slid} {struck}");
}

/// Left and right, up and down, and the two walls change places together: to the last bit.
#[test]
fn the_mirrored_motion_is_the_mirror_of_the_motion() {
    let start = State { x: 1.5, x_velocity: 0.25, y: 1.0, y_velocity: -0.5 };
    let State { x, x_velocity, y, y_velocity } = start;
    let other = State { x: -x, x_velocity: -x_velocity, y: -y, y_velocity: -y_velocity };
    let motion = |a, r, start| {
        let mut reference = Reference::new(&system(0.2, cavity(a, 0.1, r), 0.0), start, 0.0);
        let events = std::iter::from_fn(move || reference.next(40.0));
        events.take(MOST).collect::<Vec<_>>()
    };
    let mirrored = |event: &Event| match *event {
        Event::Impact { tau, side, x, loss, sticks } => {
            Event::Impact { tau, side: -side, x: -x, loss, sticks }
        }
        Event::Reversal { tau, x } => Event::Reversal { tau, x: -x },
        Event::Stick { tau, x, wall } => Event::Stick { tau, x: -x, wall: wall.map(|side| -side) },
        Event::Release { tau, x } => Event::Release { tau, x: -x },
    };
    let here = motion(0.15, [0.75, 0.25], start);
    let there = motion(-0.15, [0.25, 0.75], other);
    assert!(here.len() > 20, "{here:?}");
    assert_eq!(there.iter().map(mirrored).collect::<Vec<_>>(), here);
    assert_ne!(motion(-0.15, [0.75, 0.25], other).iter().map(mirrored).collect::<Vec<_>>(), here);
}

/// Coulomb's law without events: in a short time friction takes what it can of the relative velocity, up to
/// `f` times that time; then walls reflect. Displacements and velocities at times that are asked for.
fn stepped(system: &System, start: State, times: &[f64], step: f64) -> Vec<State> {
    let p = system.parameters();
    let (eps, total) = (p.mass_ratio, 1.0 + p.mass_ratio);
    let Cavity { gravity_along: a, friction_acceleration: f, .. } = p.cavity;
    let State { mut x, x_velocity: mut v, mut y, y_velocity: mut u } = start;
    let mut time = 0.0;
    let mut found = Vec::new();
    for wanted in times {
        while time < *wanted {
            let dt = step.min(wanted - time);
            let force = eps * p.forcing_per_clearance * libm::sin(p.frequency_ratio * time);
            v += dt * (force - eps * p.damping * v - x);
            u += dt * a;
            let drag = ((v - u) / total).clamp(-f * dt, f * dt);
            (v, u) = (v - eps * drag, u + drag);
            (x, y) = (x + dt * v, y + dt * u);
            let w = x - y;
            if w.abs() >= 1.0 && w * (v - u) > 0.0 {
                let r = system.restitutions()[usize::from(w < 0.0)];
                let exchanged = (1.0 + r) * (v - u) / total;
                (v, u) = (v - eps * exchanged, u + exchanged);
            }
            time += dt;
        }
        found.push(State { x, x_velocity: v, y, y_velocity: u });
    }
    found
}

#[test]
fn driven_and_damped_it_follows_coulombs_law() {
    let mut kinds = [0; 4];
    for (gamma, a, f, r) in [
        (4.0, 0.0, 0.15, [0.6; 2]),
        (3.0, 0.2, 0.1, [0.3, 0.7]),
        (9.0, -0.6, 0.4, [0.0, 0.5]),
        (6.0, 0.1, 0.5, [0.9; 2]),
    ] {
        let ideal = system(0.2, cavity(a, f, r), gamma).parameters();
        let driven = Parameters { damping: 0.7, frequency_ratio: 0.9, ..ideal };
        let driven = System::new(driven).expect("valid");
        let start = State { x: 0.5, x_velocity: 0.25, y: 0.25, y_velocity: -0.5 };
        let mut reference = Reference::new(&driven, start, 0.0);
        let (mut times, mut displacements) = (Vec::new(), Vec::new());
        for _ in 0..MOST {
            let Some(event) = reference.next(15.0) else { break };
            let [time, x, _, y, _] = reference.moment().map(|part| part.to_f64());
            times.push(time);
            displacements.push([x, y]);
            kinds[match event {
                Event::Impact { .. } => 0,
                Event::Reversal { .. } => 1,
                Event::Stick { .. } => 2,
                Event::Release { .. } => 3,
            }] += 1;
        }
        let largest = |step| {
            let states = stepped(&driven, start, &times, step);
            let errors = states.iter().zip(&displacements);
            errors.map(|(s, [x, y])| (s.x - x).abs().max((s.y - y).abs())).fold(0.0, f64::max)
        };
        // Its error is that of its step, of accelerations up to 10 over 15 units of time.
        let (coarse, fine) = (largest(2e-3), largest(1e-4));
        assert!(fine < 1e-3 && fine < 0.1 * coarse, "f = {f}: {coarse:e}, {fine:e}");
    }
    assert!(kinds.iter().all(|count| *count > 3), "{kinds:?}");
}

/// Between walls at which 3/4 and 1/2 of the speed are left.
#[test]
fn each_wall_has_its_restitution() {
    let level = system(LIGHT, cavity(0.0, 0.0, [0.75, 0.5]), 0.0);
    let mut reference = Reference::new(&level, absorber(0.0, 1.0), 0.0);
    let (mut time, mut speed) = (1.0, 1.0);
    for side in [-1.0, 1.0, -1.0, 1.0] {
        let Some(Event::Impact { tau, side: found, .. }) = reference.next(100.0) else { panic!() };
        assert_eq!(found, side);
        close(tau, time);
        speed *= if side > 0.0 { 0.75 } else { 0.5 };
        time += 2.0 / speed;
    }
}
