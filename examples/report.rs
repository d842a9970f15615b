//! The report of a case from a program: its verdict on the terminal, its files in a folder.
//!
//! `cargo run --release --example report -- cases/li2016-8p5hz-fig4c.toml target/report`

use std::error::Error;
use std::path::Path;

use vinesink::answer::Decided;
use vinesink::case::Case;
use vinesink::case_report::Report;
use vinesink::executor::Serial;
use vinesink::report::render;
use vinesink::store;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or("cases/li2016-8p5hz-fig4c.toml".to_owned());
    let folder = arguments.next().unwrap_or("target/report".to_owned());
    let case = Case::parse(&path, &store::read_text(Path::new(&path))?)?;
    let name = Path::new(&path).file_stem().and_then(|stem| stem.to_str()).unwrap_or("case");
    let report = Report::of(name, &case, None, Decided::ALL, &Serial)?;
    let files = report.files(&case, &Serial)?;
    store::replace_folder(Path::new(&folder), &files, render::is_of_report)?;
    println!("{}: {} files in {folder}", case.title, files.len());
    for motion in &report.answer.studied()?.motions {
        let peak_mm = 1e3 * case.units().length(motion.facts().peak.value);
        let impacts = motion.facts().impacts_per_period.value;
        println!(
            "  {}: peak {peak_mm:.3} mm, {impacts:.2} impacts per period",
            motion.regime().words()
        );
    }
    Ok(())
}
