//! Near misses: which known word was probably meant.

/// The candidate closest to `written`; `None` when nothing is close.
///
/// Another capitalisation counts as closest; otherwise at most a third of the letters, and at
/// most three, may differ.
pub(super) fn nearest<'a>(written: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let lower = written.to_lowercase();
    let distance =
        |candidate: &&str| strsim::damerau_levenshtein(&lower, &candidate.to_lowercase());
    let closest = candidates.iter().copied().min_by_key(distance)?;
    let letters = written.chars().count().max(closest.chars().count());
    (distance(&closest) <= (letters / 3).min(3)).then_some(closest)
}
