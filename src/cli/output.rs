//! Standard output and standard error.

use std::io::{self, ErrorKind, Write};

use miette::{IntoDiagnostic, Result, WrapErr};
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

/// Writes to standard error; when even that fails, nobody is left to be told.
pub fn complain(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}
