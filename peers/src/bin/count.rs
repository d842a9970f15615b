//! Runs an engine and prints its impacts, and nothing else: what `instructions` counts.
//! `count --engines` prints the engines' names.

use std::process::ExitCode;

use vinesink_peers::engine::Engine;
use vinesink_peers::{Failure, system};

fn answer() -> Result<String, Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words = Engine::ALL.map(Engine::word).join(" ");
    match &arguments[..] {
        [engine, clearance, periods] => {
            let engine = Engine::named(engine)
                .ok_or_else(|| format!("no engine {engine}: there is {words}"))?;
            let impacts = engine.impacts(&system(clearance.parse()?), periods.parse()?)?;
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
