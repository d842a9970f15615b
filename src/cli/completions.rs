//! `vinesink completions SHELL`

use clap::{Args, CommandFactory};
use clap_complete::Shell;
use miette::Result;
use vinesink::program::output;

use super::Cli;

/// Print a script that completes vinesink's commands in a shell
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// The shell to complete in
    shell: Shell,
}

const EXAMPLES: &str = "\
Examples:
  vinesink completions bash > ~/.local/share/bash-completion/completions/vinesink
  vinesink completions fish > ~/.config/fish/completions/vinesink.fish
  vinesink completions zsh > \"${fpath[1]}/_vinesink\"";

pub fn run(arguments: Arguments) -> Result<bool> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "vinesink", &mut script);
    output::print(String::from_utf8_lossy(&script))?;
    Ok(true)
}
