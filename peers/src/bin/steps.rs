//! `steps COMMAND...` runs a command one instruction at a time and prints how many there were on
//! standard error: slow (some 100,000 a second), but with every instruction that the processor has,
//! where callgrind knows no AVX-512.

use std::ffi::CString;
use std::os::unix::ffi::OsStringExt;
use std::process::ExitCode;

use nix::sys::ptrace;
use nix::sys::wait::{WaitStatus, waitpid};
use nix::unistd::{ForkResult, execvp, fork};
use vinesink_peers::Failure;

fn count(command: &[CString]) -> Result<u64, Failure> {
    let program = command.first().ok_or("usage: steps COMMAND...")?;
    // SAFETY: there is one thread, and the child does nothing before it becomes the command.
    let child = match unsafe { fork() }? {
        ForkResult::Child => {
            ptrace::traceme()?;
            return Err(execvp(program, command).map_or_else(Failure::from, |never| match never {}));
        }
        ForkResult::Parent { child } => child,
    };
    let mut steps = 0;
    loop {
        match waitpid(child, None)? {
            WaitStatus::Stopped(..) => {
                ptrace::step(child, None)?;
                steps += 1;
            }
            WaitStatus::Exited(_, 0) => return Ok(steps),
            other => return Err(format!("the command ended: {other:?}").into()),
        }
    }
}

fn main() -> ExitCode {
    let command: Result<Vec<CString>, _> =
        std::env::args_os().skip(1).map(|word| CString::new(word.into_vec())).collect();
    match command.map_err(Failure::from).and_then(|command| count(&command)) {
        Ok(steps) => {
            eprintln!("{steps}");
            ExitCode::SUCCESS
        }
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::from(2)
        }
    }
}
