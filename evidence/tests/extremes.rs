//! The ends of the range: what is trusted agrees with the reference and with the table.

use vinesink::system::{Parameters, State, System};
use vinesink_evidence::extremes::layers::rows;
use vinesink_evidence::extremes::list::table_1;
use vinesink_evidence::extremes::{CheckedLayer, RunVerdict, entries, unit_checks};
use vinesink_evidence::reference::{Event, Reference};

/// Every entry but the long runs, which the committed page has.
#[test]
#[ignore = "deep"]
fn whatever_is_trusted_agrees_with_the_reference() {
    let mut seen = [0; 3];
    for entry in entries().expect("a valid list") {
        if entry.periods > 1000 {
            continue;
        }
        let outcome = entry.outcome();
        let name = format!("{:?} {:?}", outcome.entry.varied, outcome.entry.start);
        match outcome.verdict {
            RunVerdict::Holds => {
                let comparison = outcome.measured.and_then(|measured| measured.comparison);
                assert!(
                    comparison.is_some_and(|found| found.events >= 6),
                    "{name}: {comparison:?}"
                );
                seen[0] += 1;
            }
            RunVerdict::Flagged(_) => seen[1] += 1,
            RunVerdict::Refused(_) => seen[2] += 1,
            RunVerdict::Wrong => panic!("{name}: {:?}", outcome.measured),
        }
    }
    assert!(seen[0] > 30 && seen[1] > 2 && seen[2] == 1, "{seen:?}");
}

/// Theory, decay, exact orbits, their limits and dampers against a table of 80 digits, each row within its budget of
/// operations.
#[test]
fn every_layer_holds_or_says_why() {
    let mut held = CheckedLayer::ALL.map(|layer| (layer, 0));
    let mut wrong = Vec::new();
    for row in rows().expect("a table") {
        let outcome = row.outcome().expect("a valid system");
        match outcome.verdict {
            RunVerdict::Wrong => wrong.push(format!("{row:?}: {:?}", outcome.wrong)),
            RunVerdict::Holds if outcome.compared > 0 => {
                held.iter_mut().filter(|(layer, _)| *layer == row.layer).for_each(|one| one.1 += 1);
            }
            _ => {}
        }
    }
    assert!(wrong.is_empty(), "{}: {wrong:#?}", wrong.len());
    assert!(held.iter().all(|(_, count)| *count >= 20), "{held:?}");
}

#[test]
fn a_design_does_not_know_its_unit_of_length() {
    for check in unit_checks().expect("valid cases") {
        assert!(check.holds && check.impacts > 20, "{check:?}");
    }
}

/// An unforced, undamped oscillator at rest and an absorber that drifts to the wall.
#[test]
fn the_reference_knows_what_can_be_worked_out_by_hand() {
    let system = System::new(Parameters {
        mass_ratio: 0.5,
        damping: 0.0,
        restitution: 0.5,
        forcing_per_clearance: 0.0,
        ..table_1(&[])
    })
    .expect("valid");
    let start = State { x: 0.0, x_velocity: 0.0, y: 0.0, y_velocity: 0.25 };
    let mut reference = Reference::new(&system, start, 0.0);
    let Some(Event::Impact { tau, side, x, loss, sticks }) = reference.next(10.0) else { panic!() };
    assert_eq!((tau, side, x, sticks), (4.0, -1.0, 0.0, false));
    // eps (1 - r^2) u^2 / (2 (1 + eps)) = 0.5 * 0.75 / 16 / 3
    assert!((loss - 0.0078125).abs() < 1e-17, "{loss}");
    assert_eq!(Reference::new(&system, start, 0.0).next(3.9), None);
}
