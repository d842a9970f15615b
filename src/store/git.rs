//! Reading reports out of a revision through the `git` program: no checkout, nothing is written.

use std::collections::BTreeMap;
use std::io::{self, Seek as _, Write as _};
use std::process::{Command, Output, Stdio};

use super::error::StoreError;
use super::reading::FileKind;
use super::reports::{DRAWING, REPORT, StoredReports, group};

/// The reports below `path`, relative to the working folder, at a revision; none where the folder is
/// not there. A revision `REVISION:FOLDER` brings its own folder, relative to the repository's root.
///
/// # Errors
/// [`StoreError`] says whether git, the repository or the revision is missing.
pub fn read_reports_at(revision: &str, path: &str) -> Result<StoredReports, StoreError> {
    let (commit, tree) = match revision.split_once(':') {
        Some((commit, folder)) => (commit, format!("{commit}:{folder}")),
        None => (revision, format!("{revision}:./{path}")),
    };
    is_known(revision, commit)?;
    let tree = tree.strip_suffix(REPORT).unwrap_or(&tree).trim_end_matches('/');
    // `REV:.` is no name; the root's is empty.
    let tree = tree.strip_suffix("./.").map_or(tree.to_owned(), |root| format!("{root}./"));
    let files = files(&tree).map_err(|message| failed(path, commit, &message))?;
    group(&tree, &files)
}

fn failed(path: &str, revision: &str, message: &str) -> StoreError {
    StoreError::new(format!("git cannot read `{path}` at `{revision}`: {message}"), None)
}

/// Whether there is a git, a repository, and a commit of that name in it.
fn is_known(revision: &str, commit: &str) -> Result<(), StoreError> {
    let no_file = format!("`{revision}` is no file or folder, and");
    let inside = run(&["rev-parse", "--git-dir"], None).map_err(|cause| {
        let message = format!(
            "{no_file} the program git that could know it as a revision cannot be run: {cause}"
        );
        StoreError::new(message, Some("check the path, or install git"))
    })?;
    if !inside.status.success() {
        let message = format!("{no_file} git knows no revisions here: {}", message(&inside));
        let advice = "check the path, or run this inside of the repository";
        return Err(StoreError::new(message, Some(advice)));
    }
    let found = resolve(&format!("{commit}^{{commit}}"));
    let found = found.map_err(|message| failed(revision, commit, &message))?;
    if commit.is_empty() || found.is_none() {
        let message =
            format!("`{revision}` is neither a file or folder nor a revision that git knows");
        let advice = "check the spelling; a shallow clone lacks older revisions (`git fetch --unshallow`), and a \
                      branch of the server is called origin/NAME";
        return Err(StoreError::new(message, Some(advice)));
    }
    Ok(())
}

/// The name of an object, if there is one.
fn resolve(name: &str) -> Result<Option<String>, String> {
    let arguments = ["rev-parse", "--verify", "--quiet", "--end-of-options", name];
    let output = run(&arguments, None).map_err(|cause| cause.to_string())?;
    let found = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    Ok((output.status.success() && !found.is_empty()).then_some(found))
}

/// The full name of a branch, a tag or `HEAD`, such as `refs/heads/main`; none where git knows none of that name, or nobody
/// can ask it.
pub fn name_of_ref(name: &str) -> Option<String> {
    let how =
        ["rev-parse", "--symbolic-full-name", "--verify", "--quiet", "--end-of-options", name];
    let output = run(&how, None).ok().filter(|output| output.status.success())?;
    let found = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    (!found.is_empty()).then_some(found)
}

/// The commit at which the histories of two revisions parted.
///
/// # Errors
/// [`StoreError`] where git knows one of them not, or no commit that both have.
pub fn branch_point(old: &str, new: &str) -> Result<String, StoreError> {
    is_known(old, old)?;
    is_known(new, new)?;
    let found = stdout(&["merge-base", "--end-of-options", old, new], None);
    let found = found.map(|found| String::from_utf8_lossy(&found).trim().to_owned());
    found.map_err(|_| {
        let message = format!("git finds no commit that `{old}` and `{new}` have in common");
        let advice = "a shallow clone lacks older commits: `git fetch --unshallow`";
        StoreError::new(message, Some(advice))
    })
}

/// Whether a revision has all commits of another one; true where git does not say.
pub fn is_ancestor(old: &str, new: &str) -> bool {
    let answer = run(&["merge-base", "--is-ancestor", "--end-of-options", old, new], None);
    answer.is_ok_and(|answer| answer.status.code() != Some(1))
}

/// The paths of all TOML files of a revision but hidden ones and links: those below the working folder, from there, or all
/// from the `root` of the repository.
///
/// # Errors
/// [`StoreError`] where git does not answer.
pub fn toml_files_at(commit: &str, root: bool) -> Result<Vec<String>, StoreError> {
    let mut how = vec!["ls-tree", "-r", "-z", commit];
    if root {
        how.insert(3, "--full-tree");
    }
    let list = stdout(&how, None).map_err(|message| failed("*.toml", commit, &message))?;
    let entries = list.split(|byte| *byte == 0).map(String::from_utf8_lossy);
    let path = |entry: std::borrow::Cow<str>| {
        let (facts, path) = entry.split_once('\t')?;
        let is_hidden = path.split('/').any(|name| name.starts_with('.'));
        let wanted = path.ends_with(".toml") && !is_hidden && !facts.starts_with(LINK);
        wanted.then(|| path.to_owned())
    };
    Ok(entries.filter_map(path).collect())
}

/// How the entry of a symbolic link begins.
const LINK: &str = "120000 ";

/// The files of reports in a tree, by path: every `report.json` and every drawing; none where there is no such
/// tree.
fn files(tree: &str) -> Result<BTreeMap<String, Vec<u8>>, String> {
    // What stands there may be a file; that is no folder of reports.
    let tree = match resolve(tree)? {
        Some(found) => resolve(&format!("{found}^{{tree}}"))?,
        None => None,
    };
    let Some(tree) = tree else { return Ok(BTreeMap::new()) };
    let list = stdout(&["ls-tree", "-r", "-z", "--long", "--full-tree", &tree], None)?;
    let is_report = |path: &str| path.rsplit('/').next() == Some(REPORT);
    let mut wanted = Vec::new();
    for entry in list.split(|byte| *byte == 0).map(String::from_utf8_lossy) {
        let Some((facts, path)) = entry.split_once('\t') else { continue };
        // A link is its path, and leads nowhere in a revision.
        if facts.starts_with(LINK) || !(path.ends_with(DRAWING) || is_report(path)) {
            continue;
        }
        let size = facts.rsplit(' ').next().and_then(|size| size.parse().ok());
        FileKind::Other.allows(size.unwrap_or(0)).map_err(|why| format!("`{path}` {why}"))?;
        wanted.push(path.to_owned());
    }
    let names: Vec<String> = wanted.iter().map(|path| format!("{tree}:{path}")).collect();
    let file = |(path, content): (String, Option<Vec<u8>>)| {
        let content = content.ok_or_else(|| format!("it does not return `{path}`"))?;
        Ok((path, content))
    };
    wanted.into_iter().zip(contents(&names)?).map(file).collect()
}

/// The contents of objects by their names, such as `main:./cases/a.toml`; nothing where there is none of
/// that name.
///
/// # Errors
/// [`StoreError`] where git does not answer.
pub fn read_files_at(names: &[String]) -> Result<Vec<Option<Vec<u8>>>, StoreError> {
    let first = names.first().map_or("", String::as_str);
    contents(names).map_err(|message| failed(first, "HEAD", &message))
}

/// The same in one process, whose input is a file: two pipes to one process can block each other.
fn contents(names: &[String]) -> Result<Vec<Option<Vec<u8>>>, String> {
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
