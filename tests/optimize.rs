//! Optimisation.

use std::time::Instant;
use vinesink::case::{Case, Choice, Objective};
use vinesink::optimize::{Deviation, Task};

#[test]
#[ignore = "measures"]
fn timing() {
    let text = std::fs::read_to_string("cases/li2016-band.toml").expect("text");
    let case = Case::parse("band", &text).expect("case");
    for objective in Objective::ALL {
        let task = Task::of(&case, Some(objective)).expect("task");
        let begin = Instant::now();
        let mut all = vec![];
        for k in 0..=20 {
            let choice: Choice = task.choice(&[f64::from(k) / 20.0]);
            all.push(task.score(&choice, &Deviation::default()));
        }
        println!("{objective:?} {:.2} ms each {all:?}", begin.elapsed().as_secs_f64() * 1e3 / 21.0);
    }
}
