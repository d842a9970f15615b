//! What a number of `report.json` is called, and its unit.

/// Numbers that a reviewer looks at first, by key, the most important first.
const IMPORTANT: [&str; 20] = [
    "band/worst_peak",
    "attractors/displacement/peak",
    "layers/answers/value",
    "attractors/displacement/rms",
    "attractors/impacts_per_period",
    "attractors/share_of_starts",
    "band/bare/largest_peak",
    "band/tuned_mass_damper/largest_peak",
    "band/stable_share",
    "band/z3_share",
    "bare_amplitude",
    "analysis/exact_boundaries/clearance",
    "margins/best_clearance/peak",
    "analysis/orbits/peak_displacement",
    "analysis/orbits/impact_speed",
    "analysis/orbits/spectral_radius",
    "attractors/energetics/transfer_efficiency",
    "attractors/evidence/exponent/per_period",
    "analysis/boundaries/hopf_clearance",
    "analysis/boundaries/symmetry_breaking_clearance",
];

/// Containers that a reader knows by another name, or by none.
const CONTAINERS: [(&str, &str); 13] = [
    ("analysis", ""),
    ("answers", "answer"),
    ("attractors", "motion"),
    ("band", "band:"),
    ("claims", "claim"),
    ("confirmations", "simulated:"),
    ("data", ""),
    ("energetics", ""),
    ("evidence", ""),
    ("exact_boundaries", "exact boundary"),
    ("fixed_points", "fixed point"),
    ("layers", ""),
    ("orbits", "exact orbit"),
];

/// Ends of paths with a name of their own.
const NAMES: [(&str, &str); 12] = [
    ("displacement/peak", "peak of x"),
    ("displacement/rms", "rms of x"),
    ("exponent/per_period", "Lyapunov exponent per period"),
    ("impacts_per_period", "impacts per period z"),
    ("bare/largest_peak", "worst peak without absorber"),
    ("bare_amplitude", "amplitude of the bare oscillator"),
    ("peak_displacement", "peak of x"),
    ("share_of_starts", "share of starts"),
    ("stable_share", "share with a stable 1:1 orbit"),
    ("tuned_mass_damper/largest_peak", "worst peak with the tuned mass damper"),
    ("z3_share", "share in area Z3"),
    ("worst_peak", "worst peak with the absorber"),
];

/// Place of a number in the order of importance.
pub(super) fn rank(key: &str) -> usize {
    IMPORTANT.iter().position(|important| *important == key).unwrap_or(IMPORTANT.len())
}

/// The same of a state, by its words.
pub(super) fn state_rank(what: &str) -> usize {
    let order = ["main motion", "area", "strip", "motion", "note", "exact orbit", "fixed point"];
    order.iter().position(|first| what.starts_with(first)).unwrap_or(order.len())
}

/// A path in words: `motion two-symmetric: peak of x`.
pub(super) fn label(path: &str) -> String {
    // A claim's number is a pair of the number and what it measures.
    let path = path.trim_end_matches("/number[1]");
    let (path, end) = match NAMES.iter().find(|(end, _)| ends_with(path, end)) {
        Some((end, name)) => (&path[..path.len() - end.len()], Some(*name)),
        None => (path, None),
    };
    let mut words = String::new();
    for segment in path.split('/').filter(|segment| !segment.is_empty()) {
        let (name, element) = segment.split_once('[').unwrap_or((segment, ""));
        let known = CONTAINERS.iter().find(|(container, _)| *container == name);
        push(&mut words, &known.map_or_else(|| name.replace('_', " "), |(_, name)| (*name).into()));
        let element = element.trim_end_matches(']').replace("][", " ");
        if !element.is_empty() {
            push(&mut words, &element);
            words.push(':');
        }
    }
    push(&mut words, end.unwrap_or(""));
    words.trim_end_matches(':').to_owned()
}

fn push(words: &mut String, word: &str) {
    if !words.is_empty() && !word.is_empty() {
        words.push(' ');
    }
    words.push_str(word);
}

fn ends_with(path: &str, end: &str) -> bool {
    path.strip_suffix(end).is_some_and(|rest| rest.is_empty() || rest.ends_with('/'))
}

/// Unit of a number in `report.json`; `physical` cases are in SI units, others in their own.
pub(super) fn unit(key: &str, physical: bool) -> &'static str {
    let last = key.rsplit('/').next().unwrap_or(key);
    let si = |unit: &'static str, own: &'static str| if physical { unit } else { own };
    match last {
        _ if last.ends_with("_over_clearance") => "b",
        _ if last.ends_with("_db") => "dB",
        "eta" | "Theta" | "phase" => "rad",
        "share_of_starts" | "transfer_efficiency" | "stable_share" | "z3_share" => "%",
        "peak_velocity" | "impact_speed" | "impulse_per_mass" => si("m/s", "own units"),
        "peak" | "rms" if key.starts_with("attractors/displacement/") => si("m", "own units"),
        "bare_amplitude" | "peak_displacement" | "impact_displacement" => si("m", "own units"),
        "theory" | "largest_peak" | "mean_peak" | "worst_peak" => si("m", "own units"),
        _ if key.starts_with("analysis/") && last.ends_with("clearance") => si("m", "own units"),
        _ if key.starts_with("attractors/energy/") && last != "relative_residual" => {
            si("J", "own units")
        }
        "peak" | "steady_peak" | "other_peak" => "b",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_become_words() {
        let named = [
            ("attractors[two-symmetric]/displacement/peak", "motion two-symmetric: peak of x"),
            ("attractors[at-rest]/evidence/captures/mean", "motion at-rest: captures mean"),
            ("analysis/orbits[2]/spectral_radius", "exact orbit 2: spectral radius"),
            ("analysis/boundaries/hopf_clearance", "boundaries hopf clearance"),
            ("claims[area]/observed/number[1]", "claim area: observed"),
            ("bare/largest_peak", "worst peak without absorber"),
            ("bare_amplitude", "amplitude of the bare oscillator"),
        ];
        for (path, words) in named {
            assert_eq!(label(path), words);
        }
        assert_eq!(unit("attractors/displacement/peak", true), "m");
        assert_eq!(unit("analysis/boundaries/hopf_clearance", false), "own units");
        assert_eq!(unit("attractors/displacement/peak_over_clearance", true), "b");
    }
}
