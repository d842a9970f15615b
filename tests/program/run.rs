//! Running the program.

use std::process::Output;

use assert_cmd::Command;

pub fn vinesink(arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("vinesink").expect("the program");
    // Without progress, which a busy machine would add.
    command.args(arguments).env("VINESINK_PROGRESS_SECONDS", "1000000");
    command.output().expect("it runs")
}

/// What it says when it could not be done, without the frame and the line breaks of a message.
pub fn message(arguments: &[&str]) -> String {
    let output = vinesink(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    text.split(['\n', '│', ' ']).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

/// Holds what a command says of a case against what it should, for each text that is replaced by another.
pub fn refused(command: &str, text: &str, changes: &[(&str, &str, &str)]) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("case.toml");
    for (from, to, says) in changes {
        assert!(text.contains(from), "{from}");
        std::fs::write(&path, text.replace(from, to)).expect("written");
        let told = message(&[command, path.to_str().expect("UTF-8")]);
        assert!(told.contains(says), "{to}: {told}");
    }
}
