//! Reading reports out of a revision through the `git` program: no checkout, nothing is written.

use std::collections::BTreeMap;
use std::io::{self, Seek as _, Write as _};
use std::process::{Command, Output, Stdio};

use super::StoreError;
use super::reports::{REPORT, StoredReports, group};

/// Why nothing can be read out of a revision.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum GitError {
    /// There is no `git`.
    #[error(
        "`{revision}` is no file or folder, and the program git that could know it as a revision cannot be run: {cause}"
    )]
    #[diagnostic(help("check the path, or install git"))]
    Missing {
        /// What was asked for.
        revision: String,
        /// The operating system's reason.
        cause: io::Error,
    },
    /// This is no repository, or git refuses to work in it.
    #[error("`{revision}` is no file or folder, and git knows no revisions here: {message}")]
    #[diagnostic(help("check the path, or run this inside of the repository"))]
    NoRepository {
        /// What was asked for.
        revision: String,
        /// What git says.
        message: String,
    },
    /// No such commit.
    #[error("`{revision}` is neither a file or folder nor a revision that git knows")]
    #[diagnostic(help(
        "check the spelling; a shallow clone lacks older revisions (`git fetch --unshallow`), and a branch of the server is called origin/NAME"
    ))]
    Unknown {
        /// What was asked for.
        revision: String,
    },
    /// Git failed half way.
    #[error("git cannot read `{path}` at `{revision}`: {message}")]
    Failed {
        /// The revision.
        revision: String,
        /// The folder.
        path: String,
        /// What git says.
        message: String,
    },
    /// What git returned is not usable.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Content(#[from] StoreError),
}

/// The reports below `path`, relative to the working folder, at a revision; none where the folder is
/// not there. A revision `REVISION:FOLDER` brings its own folder, relative to the repository's root.
///
/// # Errors
/// [`GitError`] says whether git, the repository or the revision is missing.
pub fn read_reports_at(revision: &str, path: &str) -> Result<StoredReports, GitError> {
    let inside = run(&["rev-parse", "--git-dir"], None)
        .map_err(|cause| GitError::Missing { revision: revision.to_owned(), cause })?;
    if !inside.status.success() {
        let message = message(&inside);
        return Err(GitError::NoRepository { revision: revision.to_owned(), message });
    }
    let (commit, tree) = match revision.split_once(':') {
        Some((commit, folder)) => (commit, format!("{commit}:{folder}")),
        None => (revision, format!("{revision}:./{path}")),
    };
    let failed = |message: String| GitError::Failed {
        revision: commit.to_owned(),
        path: path.to_owned(),
        message,
    };
    if commit.is_empty() || resolve(&format!("{commit}^{{commit}}")).map_err(failed)?.is_none() {
        return Err(GitError::Unknown { revision: revision.to_owned() });
    }
    let tree = tree.strip_suffix(REPORT).unwrap_or(&tree).trim_end_matches('/');
    // `REV:.` is no name; the root's is empty.
    let tree = tree.strip_suffix("./.").map_or(tree.to_owned(), |root| format!("{root}./"));
    // What stands there may be a file; that is no folder of reports.
    let tree_of = |found: String| resolve(&format!("{found}^{{tree}}"));
    let found = match resolve(&tree).map_err(failed)? {
        Some(found) => tree_of(found).map_err(failed)?,
        None => None,
    };
    let Some(oid) = found else { return Ok(StoredReports::new()) };
    let files = files(&oid).map_err(failed)?;
    Ok(group(&tree, &files)?)
}

/// The name of an object, if there is one.
fn resolve(name: &str) -> Result<Option<String>, String> {
    let arguments = ["rev-parse", "--verify", "--quiet", "--end-of-options", name];
    let output = run(&arguments, None).map_err(|cause| cause.to_string())?;
    let found = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    Ok((output.status.success() && !found.is_empty()).then_some(found))
}

/// The files of reports in a tree, by path: every `report.json` and every drawing.
fn files(tree: &str) -> Result<BTreeMap<String, Vec<u8>>, String> {
    let list = stdout(&["ls-tree", "-r", "-z", "--full-tree", tree], None)?;
    let mut wanted: Vec<(String, String)> = Vec::new();
    for line in list.split(|byte| *byte == 0).filter(|line| !line.is_empty()) {
        // mode, type, object, tab, path
        let line = String::from_utf8_lossy(line).into_owned();
        let (head, path) = line.split_once('\t').ok_or_else(|| format!("it lists `{line}`"))?;
        let mut head = head.split(' ').skip(1);
        let drawing = path.ends_with(".svg");
        let report = path == REPORT || path.ends_with(&format!("/{REPORT}"));
        if head.next() == Some("blob") && (drawing || report) {
            wanted.push((path.to_owned(), head.next().unwrap_or("").to_owned()));
        }
    }
    let names: Vec<&str> = wanted.iter().map(|(_, oid)| oid.as_str()).collect();
    let contents = contents(&names)?;
    let file = |((path, _), content): ((String, String), Option<Vec<u8>>)| {
        let content = content.ok_or_else(|| format!("it does not return `{path}`"))?;
        Ok((path, content))
    };
    wanted.into_iter().zip(contents).map(file).collect()
}

/// The contents of objects by their names, such as `main:./cases/a.toml`; nothing where there is none of
/// that name.
///
/// # Errors
/// [`GitError::Failed`] where git does not answer.
pub fn read_files_at(names: &[String]) -> Result<Vec<Option<Vec<u8>>>, GitError> {
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    contents(&names).map_err(|message| {
        let path = names.first().copied().unwrap_or_default().to_owned();
        GitError::Failed { revision: "HEAD".into(), path, message }
    })
}

/// The same in one process, whose input is a file: two pipes to one process can block each other.
fn contents(names: &[&str]) -> Result<Vec<Option<Vec<u8>>>, String> {
    let mut input = tempfile::tempfile().map_err(|cause| cause.to_string())?;
    let lines: String = names.iter().map(|name| format!("{name}\n")).collect();
    let written = input.write_all(lines.as_bytes()).and_then(|()| input.rewind());
    written.map_err(|cause| cause.to_string())?;
    let contents = stdout(&["cat-file", "--batch"], Some(input.into()))?;
    let mut rest = contents.as_slice();
    let mut found = Vec::new();
    for name in names {
        let (content, after) = next(rest).ok_or_else(|| format!("it does not return `{name}`"))?;
        found.push(content.map(<[u8]>::to_vec));
        rest = after;
    }
    Ok(found)
}

/// The first answer of `git cat-file --batch`, and what follows: object, type and size on a line, the
/// content, a line break; or a line that says that the object is missing.
fn next(bytes: &[u8]) -> Option<(Option<&[u8]>, &[u8])> {
    let end = bytes.iter().position(|byte| *byte == b'\n')?;
    let (line, content) = (std::str::from_utf8(&bytes[..end]).ok()?, bytes.get(end + 1..)?);
    if line.ends_with(" missing") {
        return Some((None, content));
    }
    let size = line.rsplit(' ').next()?.parse::<usize>().ok()?;
    Some((Some(content.get(..size)?), content.get(size + 1..)?))
}

fn stdout(arguments: &[&str], input: Option<Stdio>) -> Result<Vec<u8>, String> {
    let output = run(arguments, input).map_err(|cause| cause.to_string())?;
    if output.status.success() { Ok(output.stdout) } else { Err(message(&output)) }
}

fn run(arguments: &[&str], input: Option<Stdio>) -> io::Result<Output> {
    let mut command = Command::new("git");
    command.args(arguments).env("LC_ALL", "C").stdin(input.unwrap_or_else(Stdio::null));
    command.output()
}

/// The first line that git complained with.
fn message(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr);
    text.lines().next().unwrap_or("it says nothing").trim_start_matches("fatal: ").to_owned()
}

#[cfg(test)]
mod tests {
    use super::next;

    #[test]
    fn files_are_cut_out_of_the_stream() {
        let stream = b"a1 blob 3\nx\ny\nno such:name missing\nb2 blob 0\n\n";
        let (first, rest) = next(stream).expect("an answer");
        assert_eq!(first, Some(b"x\ny".as_slice()));
        let (second, rest) = next(rest).expect("an answer");
        assert_eq!(second, None, "an object that is missing");
        let (third, rest) = next(rest).expect("an answer");
        assert_eq!(third, Some(b"".as_slice()));
        assert_eq!(next(rest), None);
        assert_eq!(next(b"a1 blob 9\nshort\n"), None);
    }
}
