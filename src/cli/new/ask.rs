//! Asks on a terminal for what is known of a structure. An answer is held against what a case file may have before the next
//! question.

use std::io::{self, IsTerminal};

use dialoguer::Input;
use dialoguer::theme::SimpleTheme;
use miette::{IntoDiagnostic, Result, miette};
use vinesink::proposal::{Drive, Wish, Wishes};

use super::{FURTHER, NEEDED};

/// Refuses to ask where nobody is there to answer.
pub fn needs_terminal() -> Result<()> {
    if io::stdin().is_terminal() && io::stderr().is_terminal() {
        return Ok(());
    }
    Err(miette!(
        help = format!("without one say what is known: {NEEDED}; {FURTHER} may be left out"),
        "--guide asks on a terminal, and here is none"
    ))
}

/// How the structure is set in motion.
pub fn drive() -> Result<Drive> {
    let of = |answer: &str| match answer.trim() {
        "force" => Ok(Drive::Force),
        "base" => Ok(Drive::Base),
        "release" => Ok(Drive::Release),
        _ => Err("write force, base or release"),
    };
    let answer: String = Input::with_theme(&SimpleTheme)
        .with_prompt("What sets the structure in motion: force, base or release")
        .validate_with(|answer: &String| of(answer).map(|_| ()))
        .interact_text()
        .into_diagnostic()?;
    of(&answer).map_err(|problem| miette!("{problem}"))
}

/// The questions: what is asked, how it is put, and whether it may be left out.
fn questions(drive: Drive) -> Vec<(Wish, &'static str, bool)> {
    let (excitation, limit) = match drive {
        Drive::Force => ("Amplitude of the force, such as 14 N", LARGEST),
        Drive::Base => ("Amplitude of the base, such as 0.25 mm", LARGEST),
        Drive::Release => (
            "Displacement from which it is let go, such as 5 mm",
            "Longest time down to a tenth, such as 2 s",
        ),
    };
    let mut all = vec![
        (Wish::Mass, "Mass of the structure, of a mode its modal mass, such as 30 kg", false),
        (Wish::Frequency, "Its natural frequency, such as 6.9 Hz", false),
        (Wish::Damping, "Its damping ratio, such as 0.5 %", false),
        (Wish::Excitation, excitation, false),
        (Wish::Limit, limit, true),
    ];
    if drive != Drive::Release {
        all.push((Wish::Band, "Excitation frequencies that occur, such as 6.5 Hz to 7.2 Hz", true));
    }
    all.push((
        Wish::MassRatio,
        "Mass of the absorber over that of the structure, such as 2 %",
        true,
    ));
    all.push((Wish::Restitution, "Restitution of its walls, such as 0.3", true));
    all
}

const LARGEST: &str = "Largest displacement that is allowed, such as 4 mm";

/// Asks for all that was not said.
pub fn further(mut wishes: Wishes) -> Result<Wishes> {
    for (wish, question, optional) in questions(wishes.drive) {
        if wishes.given.iter().any(|(known, _)| *known == wish) {
            continue;
        }
        let drive = wishes.drive;
        let refused = |answer: &String| match answer.trim() {
            "" if optional => Ok(()),
            "" => Err("this is needed".to_owned()),
            _ => wish.refused(drive, &parts(wish, answer)).map_or(Ok(()), |problem| {
                let help = problem.help.unwrap_or(problem.expected);
                Err(format!("{}; {help}", problem.message))
            }),
        };
        let prompt =
            if optional { format!("{question} (or nothing)") } else { question.to_owned() };
        let answer: String = Input::with_theme(&SimpleTheme)
            .with_prompt(prompt)
            .allow_empty(true)
            .validate_with(refused)
            .interact_text()
            .into_diagnostic()?;
        if !answer.trim().is_empty() {
            wishes.given.push((wish, parts(wish, &answer)));
        }
    }
    Ok(wishes)
}

/// What an answer says: a band has two ends.
fn parts(wish: Wish, answer: &str) -> Vec<String> {
    let ends = answer.split_once(" to ").filter(|_| wish == Wish::Band);
    ends.map_or_else(|| vec![answer.to_owned()], |(from, to)| vec![from.to_owned(), to.to_owned()])
}
