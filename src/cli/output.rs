//! Standard output and standard error.

use std::io::{self, ErrorKind, Write};
use std::path::Path;

use miette::{IntoDiagnostic, Report, Result, WrapErr};
use serde::Serialize;

/// Writes a result to standard output. A reader that stops early, such as `head`, is no error.
pub fn print(text: impl AsRef<[u8]>) -> Result<()> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_ref()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).into_diagnostic().wrap_err("cannot write to standard output")
        }
        _ => Ok(()),
    }
}

/// Writes one JSON document to standard output.
pub fn print_json(document: &impl Serialize) -> Result<()> {
    let text = serde_json::to_string_pretty(document).into_diagnostic()?;
    print(format!("{text}\n"))
}

/// Writes the path of a file that was written.
pub fn print_path(path: &Path) -> Result<()> {
    print(format!("{}\n", path.display()))
}

/// Says in full why some of several things could not be done, but for the last, which is the command's own
/// error.
pub fn last_of(mut failures: Vec<Report>) -> Result<()> {
    let last = failures.pop();
    failures.iter().for_each(|error| complain(&format!("{error:?}")));
    last.map_or(Ok(()), Err)
}

/// Writes to standard error; when even that fails, nobody is left to be told.
pub fn complain(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}
