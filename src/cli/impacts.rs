//! The file of impacts that `vinesink simulate --impacts` writes: CSV, a line each.

use std::fmt::Write as _;
use std::path::Path;

use miette::Result;
use vinesink::answer::trajectory::Impact;
use vinesink::case::ModalCase;
use vinesink::modal::LoadImpact;
use vinesink::motions::Motions;
use vinesink::store;

/// Columns of every structure, in parts between which those of several absorbers and loads stand.
const COLUMNS: [&str; 2] = ["tau,side", "x,xdot_before,xdot_after,ydot_before,ydot_after"];

/// Writes impacts of one mode with one absorber.
pub fn write(file: &Path, impacts: &[Impact]) -> Result<()> {
    let numbers = |one: &Impact| {
        let before = [one.x_velocity_before, one.y_velocity_before];
        let after = [one.x_velocity_after, one.y_velocity_after];
        [one.tau, one.x, before[0], after[0], before[1], after[1]]
    };
    let lines = impacts.iter().map(|one| line(one.side.sign(), numbers(one), "", ""));
    written(file, ["", ""], lines)
}

/// The same of several absorbers: the number of the absorber, and under which load, at which frequency and in which motion.
pub fn write_of_loads(file: &Path, case: &ModalCase, impacts: &[LoadImpact]) -> Result<()> {
    let lines = impacts.iter().map(|one| {
        let absorber = format!(",{}", one.absorber);
        let of = format!(",{},{},{}", one.load, one.at, Motions::id(one.motion));
        line(one.side.sign(), one.over_clearance(case), &absorber, &of)
    });
    written(file, [",absorber", ",load,frequency,motion"], lines)
}

/// `tau` and the numbers behind the side. Rust prints the shortest text that reads back to the same number.
fn line(side: f64, [tau, numbers @ ..]: [f64; 6], absorber: &str, of: &str) -> String {
    let side = if side > 0.0 { "+1" } else { "-1" };
    let numbers = numbers.map(|number| number.to_string()).join(",");
    format!("{tau},{side}{absorber},{numbers}{of}")
}

fn written(file: &Path, further: [&str; 2], lines: impl Iterator<Item = String>) -> Result<()> {
    let ([first, last], [absorber, of]) = (COLUMNS, further);
    let mut text = format!("{first}{absorber},{last}{of}\n");
    for line in lines {
        // Writing into a text does not fail.
        let _ = writeln!(text, "{line}");
    }
    Ok(store::write_file(file, text.as_bytes())?)
}
