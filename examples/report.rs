//! The report of a case from a program: its verdict on the terminal, its files in a folder.
//!
//! `cargo run --release --example report -- cases/li2016-8p5hz-fig4c.toml target/report`

use std::error::Error;
use std::path::Path;

use vinesink::case::Case;
use vinesink::report::document::{self, Source};
use vinesink::report::{equations, figures, render, template};
use vinesink::store;
use vinesink::study::plots::Plot;
use vinesink::study::{CaseStudy, StudyEffort};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or("cases/li2016-8p5hz-fig4c.toml".to_owned());
    let folder = arguments.next().unwrap_or("target/report".to_owned());
    let case = Case::parse(&path, &store::read_text(Path::new(&path))?)?;
    let study = CaseStudy::of(&case.system(), StudyEffort::of(&case.simulation), &mut |_| ())?;
    let units = document::units(&case);
    let drawn = figures::all(&case, &study, &Plot::all(&case, &study)?);
    let drawn = template::worded(drawn, &units)?;
    let name = Path::new(&path).file_stem().and_then(|stem| stem.to_str()).unwrap_or("case");
    let document = document::document(&Source {
        name,
        case: &case,
        study: &study,
        judged: &[],
        answers: None,
        figures: &drawn,
    });
    let files = render::files(&document, &equations::groups(&case, &study), &units, &drawn)?;
    store::replace_folder(Path::new(&folder), &files, render::is_of_report)?;
    println!("{}: {} files in {folder}", case.title, files.len());
    for found in &study.motions.attractors {
        let peak_mm = 1e3 * case.scales().length(found.attractor.peak);
        let impacts = found.attractor.impacts_per_period;
        println!("  peak {peak_mm:.3} mm, {impacts:.2} impacts per period");
    }
    Ok(())
}
