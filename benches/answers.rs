//! What an answer takes beside another on the same case: all that `check` knows beside what `simulate` does, for every
//! shipped case that is driven steadily, in the same run.
//!
//! The lines printed are the ratios. Nothing here asserts a time.

use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use vinesink::answer::{Answer, Asked};
use vinesink::case::Case;
use vinesink::executor::Serial;
use vinesink::motions::Measured;
use vinesink::excitation::Scene;

fn timed(mut work: impl FnMut()) -> Duration {
    let mut best = Duration::MAX;
    for _ in 0..5 {
        let begin = Instant::now();
        work();
        best = best.min(begin.elapsed());
    }
    best
}

fn main() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("the folder of cases")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
        .collect();
    files.sort();
    for file in files {
        let text = std::fs::read_to_string(&file).expect("a text");
        let Ok(case) = Case::parse("case.toml", &text) else { continue };
        if case.design.scene() != Scene::Steady {
            continue;
        }
        let simulated = timed(|| {
            let answer = Answer::of(&case, Asked::Motions, None, &Serial).expect("finite");
            black_box(answer.main(&case, &mut Measured::log()).expect("finite"));
        });
        let checked = timed(|| {
            black_box(Answer::of(&case, Asked::Criteria, None, &Serial).expect("finite"));
        });
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        let ratio = checked.as_secs_f64() / simulated.as_secs_f64();
        let band = if case.band.is_some() { ", over a band" } else { "" };
        println!("{name}: check {checked:.1?}{band}, {ratio:.2} times as long as simulate");
    }
}
