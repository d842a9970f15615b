//! What an engine gives a task that it starts: the number of its first chunk, its share of all of them, and
//! processors.

use miette::{IntoDiagnostic, Result, miette};

/// The chunks to work out: a single one, with `every` also each so many after it, or all.
pub fn chunks(first: Option<u64>, every: Option<u64>, all: u64) -> Result<Vec<u64>> {
    match (first.map_or_else(numbered, |first| Ok(Some(first)))?, every) {
        (Some(first), _) if first >= all => Err(miette!(
            help = format!("the last chunk is {}", all - 1),
            "there is no chunk {first}"
        )),
        (Some(first), Some(step)) => Ok(share(first, step, all)),
        (Some(first), None) => Ok(vec![first]),
        (None, Some(_)) => Err(miette!(
            help = "say which with `--chunk N`; an engine's tasks have a number already",
            "`--every` counts from a chunk, and there is none"
        )),
        (None, None) => Ok((0..all).collect()),
    }
}

/// The chunk that the engine which started this process has given it. HyperQueue runs inside Slurm's jobs
/// and not the other way around, so its word counts first.
fn numbered() -> Result<Option<u64>> {
    let told = |name: &str| Some((name.to_owned(), std::env::var(name).ok()?));
    let Some((name, text)) = told("HQ_TASK_ID").or_else(|| told("SLURM_ARRAY_TASK_ID")) else {
        return Ok(None);
    };
    text.parse().map(Some).map_err(|_| miette!("{name} is {text}, no number"))
}

/// The chunks of one of `step` tasks.
fn share(first: u64, step: u64, chunks: u64) -> Vec<u64> {
    let next = |chunk: &u64| chunk.checked_add(step).filter(|next| *next < chunks);
    std::iter::successors(Some(first).filter(|first| *first < chunks), next).collect()
}

/// Uses as many processors as were asked for, or as the engine that started this process has given it.
pub fn keep_to_processors(asked: Option<u16>) -> Result<()> {
    let told = |name: &str| std::env::var(name).ok();
    let threads = match asked {
        Some(threads) => Some(usize::from(threads)),
        None => granted(told("HQ_CPUS").as_deref(), told("SLURM_CPUS_PER_TASK").as_deref())?,
    };
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().into_diagnostic()
}

/// How many processors the engine says: HyperQueue, which may itself run inside Slurm, lists them, and Slurm
/// counts them.
fn granted(hyperqueue: Option<&str>, slurm: Option<&str>) -> Result<Option<usize>> {
    if let Some(list) = hyperqueue {
        let count = list.split(',').filter(|processor| !processor.trim().is_empty()).count();
        return Ok(Some(count.max(1)));
    }
    let Some(text) = slurm else { return Ok(None) };
    match text.parse() {
        Ok(count) if count > 0 => Ok(Some(count)),
        _ => Err(miette!(
            help = "say how many with --threads",
            "SLURM_CPUS_PER_TASK is {text:?}, no number of processors"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As HyperQueue and Slurm document their variables.
    #[test]
    fn processors_are_those_of_the_innermost_engine() {
        let counted = |hyperqueue, slurm| granted(hyperqueue, slurm).expect("numbers");
        assert_eq!(counted(None, None), None);
        assert_eq!(counted(None, Some("8")), Some(8));
        assert_eq!(counted(Some("3"), Some("8")), Some(1));
        assert_eq!(counted(Some("0,2,17"), None), Some(3));
        for wrong in ["", "0", "-1", "8(x2)"] {
            assert!(granted(None, Some(wrong)).is_err(), "{wrong}");
        }
    }

    /// Every chunk once, whatever the number of tasks.
    #[test]
    fn shares_are_all_chunks_once() {
        for tasks in 1..9 {
            let mut all: Vec<u64> = (0..tasks).flat_map(|task| share(task, tasks, 7)).collect();
            all.sort_unstable();
            assert_eq!(all, [0, 1, 2, 3, 4, 5, 6], "{tasks}");
        }
        assert_eq!(share(3, u64::MAX, u64::MAX), [3]);
    }
}
