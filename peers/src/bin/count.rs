//! Runs an engine and prints its impacts, and nothing else: what `instructions` counts.
//! `count --engines` prints the engines' names.

use std::process::ExitCode;

use vinesink_peers::engine::Engine;
use vinesink_peers::{Failure, several, system};

fn answer() -> Result<String, Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words = Engine::ALL.map(|engine| engine.word().to_owned()).into_iter();
    let words: Vec<String> = words.chain(several::SIZES.map(several::word)).collect();
    let words = words.join(" ");
    match &arguments[..] {
        [engine, clearance, periods] => {
            let (clearance, periods) = (clearance.parse()?, periods.parse()?);
            let size = several::SIZES.into_iter().find(|size| several::word(*size) == *engine);
            let impacts = match (size, Engine::named(engine)) {
                (Some(size), _) => several::impacts(size, clearance, periods)?,
                (None, Some(engine)) => engine.impacts(&system(clearance), periods)?,
                (None, None) => return Err(format!("no engine {engine}: there is {words}").into()),
            };
            Ok(impacts.to_string())
        }
        [option] if option == "--engines" => Ok(words),
        _ => Err("usage: count ENGINE CLEARANCE_MM PERIODS, or count --engines".into()),
    }
}

fn main() -> ExitCode {
    match answer() {
        Ok(answer) => {
            println!("{answer}");
            ExitCode::SUCCESS
        }
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::from(2)
        }
    }
}
