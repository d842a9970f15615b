use vinesink::analysis::Analysis;
use vinesink::band::Inactive;
use vinesink::case::Case;
use vinesink::orbits::FullSystem;
use vinesink::system::System;
use vinesink::validation::{Claim, Verdict, confront_simulation, confront_theory};
use vinesink::regimes::Window;

const TILTED: &str = include_str!("../cavity/tilted.toml");
const KEYS: &str = "restitution = [0.65, 0.55]\ninclination = \"0.5 deg\"\nfriction = \"0.3 %\"\n";

fn case(keys: &str) -> Case {
    let text = TILTED.replacen(KEYS, keys, 1);
    Case::parse("case.toml", &text).unwrap_or_else(|error| panic!("{error:?}"))
}
const WINDOW: Window = Window { discard: 200, periods: 20, impact_limit: 100_000 };
fn claims(system: &System) -> Vec<Claim> {
    let (analysis, exact) = (Analysis::of(system).expect("theory"), FullSystem::of(system));
    let inactive = Inactive::of(system);
    let mut all = confront_theory(&analysis, &exact);
    all.extend(confront_simulation(&analysis, &exact, inactive.as_ref(), &[], &WINDOW).expect("runs"));
    all
}
#[test]
fn explore() {
    for tilt in ["0", "0.2", "0.5", "1", "2"] { for mu in ["0", "0.1", "0.3", "2", "5", "20"] { for r in ["0.6", "[0.65, 0.55]", "[0.8, 0.4]"] {
      for b in [1.0, 0.6, 1.8] {
        let case = case(&format!("restitution = {r}\ninclination = \"{tilt} deg\"\nfriction = \"{mu} %\"\n"));
        let system = case.system().with_clearance_scaled(b).expect("valid");
        if system.cavity().is_ideal() { continue; }
        for c in claims(&system) {
            let t = c.id.contains("t_1");
            if c.verdict != Verdict::Confirmed || t {
              println!("{tilt} {mu} {r} {b} {:?} {} {:?} {:?} {:?} of {}", c.verdict, c.id, c.predicted, c.observed, c.difference, c.tolerance);
            }
        }
    }}}}
}
