//! What commands say of one design, held against one another.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::designs::Design;
use crate::program::Bench;

/// Fields of a motion that every list has.
const FIELDS: [&str; 16] = [
    "id",
    "kind",
    "regime",
    "settled",
    "counts",
    "why_not",
    "peak",
    "rms",
    "impacts_per_period",
    "impact_speed",
    "efficiency",
    "starts",
    "of_starts",
    "share",
    "repeats_after",
    "largest_multiplier",
];
/// Relative difference of numbers that are one: they are written in decimal digits, and converted.
const SAME: f64 = 1e-9;
/// Relative difference of what two solvers give for one orbit: that of Newton's method.
const SOLVED: f64 = 1e-6;
/// Part of a band beside the end of a stable stretch in which either may be said: how far the end is a root.
const AT_END: f64 = 1e-6;

/// Comparisons.
#[derive(Default)]
pub struct Tally {
    pub agreed: usize,
    pub contradictions: Vec<String>,
}

impl Tally {
    pub fn add(&mut self, other: Self) {
        self.agreed += other.agreed;
        self.contradictions.extend(other.contradictions);
    }
}

/// The comparisons of one design.
struct Judge<'a> {
    design: &'a str,
    tally: Tally,
}

impl Judge<'_> {
    fn holds(&mut self, holds: bool, what: impl FnOnce() -> String) {
        match holds {
            true => self.tally.agreed += 1,
            false => self.tally.contradictions.push(format!("{}: {}", self.design, what())),
        }
    }

    fn same(&mut self, what: &str, a: &Value, b: &Value) {
        self.holds(is_same(a, b), || format!("{what}: {a} and {b}"));
    }

    fn near(&mut self, what: &str, a: f64, b: f64, within: f64) {
        self.holds((a - b).abs() <= within || a == b, || format!("{what}: {a} and {b}"));
    }

    /// Lists of two commands, field by field.
    fn lists(&mut self, what: &str, a: &[Value], b: &[Value]) {
        self.holds(a.len() == b.len(), || format!("{what}: {} and {} motions", a.len(), b.len()));
        for (k, (a, b)) in a.iter().zip(b).enumerate() {
            for field in FIELDS {
                let [a, b] = [&a[field], &b[field]].map(plain);
                self.same(&format!("{what}, m{} {field}", k + 1), &a, &b);
            }
        }
    }
}

/// A number with its error, whatever else is said of it.
fn plain(of: &Value) -> Value {
    match of["value"].is_null() {
        true => of.clone(),
        false => serde_json::json!({ "value": of["value"], "error": of["error"] }),
    }
}

fn is_same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let [a, b] = [a, b].map(|one| one.as_f64().unwrap_or(f64::NAN));
            a == b || (a - b).abs() <= SAME * a.abs().max(b.abs())
        }
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len()
                && a.iter().all(|(key, one)| b.get(key).is_some_and(|b| is_same(one, b)))
        }
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_same(a, b))
        }
        _ => a == b,
    }
}

fn list(of: &Value) -> &[Value] {
    of.as_array().map_or(&[], Vec::as_slice)
}

fn number(of: &Value) -> f64 {
    of.as_f64().unwrap_or(f64::NAN)
}

/// The main motion of a list: the moving one that most starts lead to, or else that at rest.
fn main_of(motions: &[Value]) -> Option<&Value> {
    let moving = motions.iter().filter(|one| one["kind"] != "rest" && number(&one["starts"]) > 0.0);
    let most = moving.rev().max_by(|a, b| number(&a["starts"]).total_cmp(&number(&b["starts"])));
    most.or_else(|| motions.iter().find(|one| one["kind"] == "rest")).or(motions.first())
}

/// Whether a value lies between ends; one that is missing does not limit it.
fn is_within(value: f64, [from, to]: [f64; 2]) -> bool {
    (from.is_nan() || value >= from) && (to.is_nan() || value <= to)
}

fn is_one_to_one(motion: &Value) -> bool {
    let two = motion["regime"] == "two-symmetric" || motion["regime"] == "two-asymmetric";
    two && motion["repeats_after"] == 1 && motion["kind"] != "rest"
}

/// What all commands say of a design; `more` are those that take longer.
pub fn compared(design: &Design, more: bool, optimised: bool) -> Tally {
    let bench = Bench::new(design);
    let mut judge = Judge { design: &design.name, tally: Tally::default() };
    let documents = [
        bench.json("simulate", &[]),
        bench.json("analyze", &[]),
        bench.json("check", &["--criteria-only"]),
        bench.report(),
    ];
    let [Some(simulated), Some(analysed), Some(checked), Some(report)] = documents else {
        judge.holds(false, || "a command gives no document".into());
        return judge.tally;
    };
    let checked = &checked["cases"][0];
    let motions = list(&simulated["motions"]);
    // With [accuracy] nothing is simulated that another layer knows well enough.
    let other = [("analyze", &analysed), ("check", checked), ("report", &report)];
    for (command, document) in other {
        if command == "check" || document["answers"].is_null() {
            judge.lists(&format!("simulate and {command}"), motions, list(&document["motions"]));
        }
    }
    order(&mut judge, motions);
    headlines(&mut judge, motions, &simulated, &report);
    stability(&mut judge, motions, &analysed, checked, &report);
    criteria(&mut judge, motions, checked, &report);
    swept(&mut judge, &bench, &design.text, motions, &analysed, &report);
    if more {
        traded(&mut judge, &bench, motions, &simulated, &report);
    }
    if optimised {
        optimum(&mut judge, &bench);
    }
    judge.tally
}

/// The same of a structure of several modes under one load: lists of motions, their order, and criteria.
pub fn compared_of_several(design: &Design) -> Tally {
    let bench = Bench::new(design);
    let mut judge = Judge { design: &design.name, tally: Tally::default() };
    let documents =
        [bench.json("simulate", &[]), bench.json("check", &["--criteria-only"]), bench.report()];
    let [Some(simulated), Some(checked), Some(report)] = documents else {
        judge.holds(false, || "a command gives no document".into());
        return judge.tally;
    };
    let checked = &checked["cases"][0];
    // At one frequency, or at each of a range.
    let lists = |of: &Value| -> Vec<Vec<Value>> {
        match of["places"].as_array() {
            Some(places) => places.iter().map(|one| list(&one["motions"]).to_vec()).collect(),
            None => vec![list(&of["motions"]).to_vec()],
        }
    };
    let own = lists(&simulated);
    for (command, document) in [("check", checked), ("report", &report)] {
        let others = lists(document);
        judge.holds(others.len() == own.len(), || format!("{command}: other frequencies"));
        for (own, other) in own.iter().zip(&others) {
            judge.lists(&format!("simulate and {command}"), own, other);
        }
    }
    own.iter().for_each(|motions| order(&mut judge, motions));
    for one in own.iter().flatten() {
        // The largest of its parts.
        let largest = |part: &str, key: &str| {
            let each = list(&one[part]).iter().map(|of| number(&of[key]["value"]));
            each.fold(0.0, f64::max)
        };
        for (part, key) in
            [("places", "peak"), ("places", "rms"), ("absorbers", "impacts_per_period")]
        {
            judge.near(
                &format!("{key} of {part}"),
                number(&one[key]["value"]),
                largest(part, key),
                SAME,
            );
        }
    }
    criteria(&mut judge, list(&simulated["motions"]), checked, &report);
    judge.tally
}

/// Keeps the case of a contradiction, so that it can be looked at.
pub fn kept(design: &Design) -> PathBuf {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}.toml", design.name));
    std::fs::write(&file, &design.text).expect("written");
    file
}

/// Ids by share, then peak; shares that are shares; what counts and why not.
fn order(judge: &mut Judge, motions: &[Value]) {
    judge.holds(!motions.is_empty(), || "no motion".into());
    for (k, one) in motions.iter().enumerate() {
        judge.holds(one["id"] == format!("m{}", k + 1), || {
            format!("{} is not m{}", one["id"], k + 1)
        });
        judge.holds(one["counts"] == one["why_not"].is_null(), || format!("counts: {one}"));
        let share = number(&one["share"]);
        let rests = one["kind"] == "rest" || !list(&one["resting"]).is_empty();
        if !rests {
            let of_starts = number(&one["starts"]) / number(&one["of_starts"]).max(1.0);
            judge.near("share of starts", share, of_starts, SAME);
        }
        let below = one["why_not"] == "below-threshold";
        let rare = rests && share < 0.01 && one["starts"] == 0;
        judge.holds(below == rare || one["why_not"] == "left-out", || format!("threshold: {one}"));
    }
    for pair in motions.windows(2) {
        let [a, b] =
            [&pair[0], &pair[1]].map(|one| (number(&one["share"]), number(&one["peak"]["value"])));
        judge.holds(a >= b, || format!("{a:?} before {b:?}"));
    }
    let kinds = |kind: &str| motions.iter().filter(|one| one["kind"] == kind).count();
    judge.holds(kinds("rest") <= 1, || "two motions at rest".into());
    let led: f64 = motions.iter().map(|one| number(&one["starts"])).sum();
    judge.holds(led <= number(&motions[0]["of_starts"]), || format!("{led} starts"));
}

/// The numbers that stand for a case are those of its main motion.
fn headlines(judge: &mut Judge, motions: &[Value], simulated: &Value, report: &Value) {
    let Some(main) = main_of(motions) else { return };
    judge.same("simulate, regime", &simulated["regime"], &main["regime"]);
    judge.same("simulate, peak", &simulated["displacement"]["peak"], &main["peak"]["value"]);
    judge.same("simulate, rms", &simulated["displacement"]["rms"], &main["rms"]["value"]);
    let impacts = &main["impacts_per_period"]["value"];
    judge.same("simulate, z", &simulated["impacts_per_period"], impacts);
    judge.same(
        "simulate, speed",
        &plain(&simulated["motion"]["impact_speed"]),
        &main["impact_speed"],
    );
    judge.same("simulate, settled", &simulated["settled"], &main["settled"]);
    if report["answers"].is_null() {
        let quantities = &report["quantities"];
        judge.same("report, peak", &plain(&quantities["peak_displacement"]), &main["peak"]);
        judge.same("report, rms", &plain(&quantities["rms_displacement"]), &main["rms"]);
        let index = report["main"].as_u64().unwrap_or(u64::MAX) as usize;
        let id = list(&report["motions"]).get(index).map_or(&Value::Null, |one| &one["id"]);
        judge.same("report, main", id, &main["id"]);
        let bare = number(&quantities["bare_peak"]["value"]);
        if let (Some(change), true) = (quantities["change_db"]["value"].as_f64(), bare.is_finite())
        {
            let wanted = 20.0 * libm::log10(number(&main["peak"]["value"]) / bare);
            judge.near("report, change", change, wanted, 1e-6);
        }
        let efficiency = number(&main["efficiency"]["value"]);
        if efficiency.is_finite() {
            let told = &list(&report["motions"])[index];
            judge.same("report, efficiency", &plain(&told["efficiency"]), &main["efficiency"]);
        }
    }
}

/// Where a 1:1 motion attracts, by every command.
fn stability(
    judge: &mut Judge,
    motions: &[Value],
    analysed: &Value,
    checked: &Value,
    report: &Value,
) {
    let theory = &analysed["theory"];
    let real = !theory["cavity"].is_null();
    let orbits = if real { &theory["cavity"]["orbits"] } else { &theory["orbits"] };
    let of_list = |orbit: &&Value| is_one_to_one(orbit) && orbit["kind"] == "orbit";
    let listed: Vec<&Value> = motions.iter().filter(of_list).collect();
    let listed: Vec<&Value> =
        listed.into_iter().filter(|one| real || one["regime"] == "two-symmetric").collect();
    let attracting = |one: &&Value| one["stable"] == true && one["admissible"] == true;
    let solved: Vec<&Value> = list(orbits).iter().filter(attracting).collect();
    judge.holds(solved.len() == listed.len() || real, || {
        format!("{} attracting orbits by analyze, {} in the list", solved.len(), listed.len())
    });
    for one in &solved {
        let peak = number(&one["peak"]["value"]);
        let is_one =
            |other: &&&Value| (number(&other["peak"]["value"]) / peak - 1.0).abs() < SOLVED;
        judge.holds(listed.iter().any(|other| is_one(&other)), || {
            format!("an orbit that attracts by analyze is not listed: peak {peak}")
        });
    }
    for one in &listed {
        let peak = number(&one["peak"]["value"]);
        let is_one =
            |other: &&&Value| (number(&other["peak"]["value"]) / peak - 1.0).abs() < SOLVED;
        judge.holds(solved.iter().any(|other| is_one(&other)), || {
            format!("an orbit of the list does not attract by analyze: peak {peak}")
        });
    }
    if !real {
        let here = theory["stable_here"] == true;
        judge.holds(here != listed.is_empty(), || "stable_here against the list".into());
        let clearance = number(&report["quantities"]["clearance"]["value"]);
        let inside = list(&theory["stretches"]).iter().any(|stretch| {
            let end = |k: usize| number(&stretch[k]["at"]["value"]);
            is_within(clearance, [end(0), end(1)])
        });
        judge.holds(inside == here, || {
            format!("stretches of stability against the orbit at {clearance}")
        });
    }
    let limits = &report["theory"]["limits"]["clearance"];
    if !limits.is_null() {
        let clearance = number(&report["quantities"]["clearance"]["value"]);
        let end = |k: usize| number(&limits[k]["at"]["value"]);
        judge.holds(is_within(clearance, [end(0), end(1)]), || {
            format!("{clearance} outside of its limits {} to {}", end(0), end(1))
        });
        judge.holds(motions.iter().any(is_one_to_one), || {
            "limits of a motion that is not listed".into()
        });
    }
    let steady = motions.iter().any(is_one_to_one);
    let band = &report["band"];
    let share = criterion(checked, "stable_share").map(|one| number(&one["found"]));
    if band.is_null() {
        if let Some(share) = share {
            judge.near("stable share at one excitation", share, f64::from(u8::from(steady)), 0.0);
        }
        return;
    }
    if let Some(share) = share {
        judge.near("stable share", share, number(&band["stable_share"]["value"]), SAME);
    }
    let [from, to] = ["from", "to"].map(|end| number(&band[end]["value"]));
    for place in list(&report["places"]) {
        let at = number(&place["at"]);
        let near = |end: f64| (at - end).abs() < AT_END * (to - from);
        let ends =
            list(&band["stable"]).iter().map(|pair| [0, 1].map(|k| number(&pair[k]["value"])));
        let ends: Vec<[f64; 2]> = ends.collect();
        if ends.iter().flatten().any(|end| near(*end)) {
            continue;
        }
        let inside = ends.iter().any(|[low, high]| *low <= at && at <= *high);
        let here = list(&place["motions"]).iter().any(is_one_to_one);
        judge.holds(inside == here, || {
            format!("1:1 at {at}: {here} by its list, {inside} by the band")
        });
    }
}

fn criterion<'a>(checked: &'a Value, name: &str) -> Option<&'a Value> {
    list(&checked["criteria"]).iter().find(|one| one["name"] == name)
}

/// What is found is a number of a motion of the list at its place, and the worst of all that are listed.
fn criteria(judge: &mut Judge, motions: &[Value], checked: &Value, report: &Value) {
    let own = motions.to_vec();
    let places: Vec<(f64, &[Value])> = match checked["places"].as_array() {
        Some(places) => {
            places.iter().map(|one| (number(&one["at"]), list(&one["motions"]))).collect()
        }
        None => vec![(f64::NAN, own.as_slice())],
    };
    if checked["own_in_band"] == true {
        let own = report["band"]["own"]["value"].as_f64().unwrap_or(f64::NAN);
        let here = places.iter().find(|place| (place.0 - own).abs() <= SAME * own);
        if criterion(checked, "no_coexistence").is_some() {
            judge.lists("its own place in the band", motions, here.map_or(&[], |here| here.1));
        }
    }
    let bare = match report["band"]["bare"]["peak"]["value"].as_f64() {
        Some(bare) => bare,
        None => number(&report["quantities"]["bare_peak"]["value"]),
    };
    for one in list(&checked["criteria"]) {
        let name = one["name"].as_str().unwrap_or_default();
        let told = list(&report["criteria"]["all"]).iter().find(|other| other["name"] == name);
        if let Some(told) = told {
            judge.same(
                &format!("{name}, found"),
                &one["found"],
                match name {
                    "no_coexistence" => &one["found"],
                    _ => &told["found"]["value"],
                },
            );
            judge.same(&format!("{name}, holds"), &one["holds"], &told["holds"]);
            judge.same(&format!("{name}, motion"), &one["motion"], &told["motion"]);
            judge.same(&format!("{name}, at"), &one["at_value"], &told["at"]["value"]);
        }
        judge
            .holds(one["decided"] == true || one["holds"] == false, || format!("undecided: {one}"));
        let here = match one["at_value"].as_f64() {
            Some(at) if checked["places"].is_array() => places.iter().find(|place| place.0 == at),
            _ => places.first().filter(|_| places.len() == 1),
        };
        let value = |motion: &Value| {
            let [peak, rms, speed] =
                ["peak", "rms", "impact_speed"].map(|key| motion[key]["value"].as_f64());
            match name {
                "peak_displacement" => peak,
                "rms_displacement" => rms,
                "impact_velocity" => speed,
                "reduction_db" => peak.map(|peak| 20.0 * libm::log10(bare / peak)),
                _ => None,
            }
        };
        let counting =
            |motions: &[Value]| motions.iter().filter(|one| one["counts"] == true).count();
        let found = number(&one["found"]);
        match name {
            "no_coexistence" if found == 1.0 => {
                for (at, motions) in &places {
                    judge.holds(counting(motions) <= 1, || format!("no other motion, but at {at}"));
                }
            }
            "no_coexistence" => {
                let several = here.is_some_and(|(_, motions)| counting(motions) > 1);
                judge.holds(several, || format!("another motion, but not where it is said: {one}"));
            }
            "peak_displacement" | "rms_displacement" | "impact_velocity" | "reduction_db" => {
                let id = &one["motion"];
                let motion =
                    here.and_then(|(_, all)| all.iter().find(|motion| motion["id"] == *id));
                let number = motion.and_then(value);
                let near = number
                    .is_some_and(|number| (number - found).abs() <= 1e-6 * found.abs().max(1e-3));
                let silent =
                    places.iter().all(|(_, all)| all.iter().all(|motion| value(motion).is_none()));
                judge
                    .holds(near || silent && one["found"].is_null() || one["found"] == 0.0, || {
                        format!("{name}: found {found}, its motion has {number:?}: {one}")
                    });
                let counted = places.iter().flat_map(|(_, all)| *all);
                let counted = counted.filter(|motion| motion["counts"] == true).filter_map(value);
                let worst =
                    counted.reduce(|a, b| if name == "reduction_db" { a.min(b) } else { a.max(b) });
                if let Some(worst) = worst {
                    judge.near(
                        &format!("{name}: found and the worst of the lists"),
                        found,
                        worst,
                        1e-6 * worst.abs().max(1e-3),
                    );
                }
            }
            _ => {}
        }
    }
}

/// A sweep's columns at the case's own point.
fn swept(
    judge: &mut Judge,
    bench: &Bench,
    text: &str,
    motions: &[Value],
    analysed: &Value,
    report: &Value,
) {
    if text.contains("[sweep]") || text.contains("[accuracy]") {
        return;
    }
    let Some(line) = text.lines().find(|line| line.trim_start().starts_with("clearance =")) else {
        return;
    };
    // The table [absorber], or [reduced], has it, and others of this name come after.
    let written =
        line.split('=').nth(1).unwrap_or_default().split('#').next().unwrap_or_default().trim();
    let bare = written.trim_matches('"');
    let (value, unit) = bare.split_once(' ').unwrap_or((bare, ""));
    let Ok(size) = value.parse::<f64>() else { return };
    let last = format!("{} {unit}", 1.01 * size);
    let last = if written.starts_with('"') { format!("\"{last}\"") } else { last };
    let starts = motions.first().map_or(32, |one| one["of_starts"].as_u64().unwrap_or(32));
    let periods = periods(text);
    let table = format!(
        "{text}\n[sweep]\nclearance = {{ from = {written}, to = {last}, count = 2 }}\nstarts = {starts}\nperiods = {periods}\n\
         record = [\"orbit_peak\", \"orbit_multiplier\", \"orbit_reached\", \"regime\", \"impacts_per_period\", \"peak\", \"rms\",\
         \"reduction_db\", \"efficiency\", \"impact_speed\", \"repeats_after\", \"share_of_starts\", \"largest_peak\", \"motions\"]\n"
    );
    let Some(row) = bench.row(&table) else {
        judge.holds(false, || "no sweep".into());
        return;
    };
    let Some(main) = main_of(motions) else { return };
    let cell =
        |name: &str| row.iter().find(|(column, _)| column == name).map(|(_, cell)| cell.as_str());
    let read = |name: &str| cell(name).and_then(|cell| cell.parse::<f64>().ok());
    let mut column = |name: &str, wanted: Option<f64>| {
        let found = read(name);
        let same = match (found, wanted) {
            (Some(a), Some(b)) => a == b || (a - b).abs() <= 1e-6 * a.abs().max(b.abs()),
            (a, b) => a.is_none() && b.is_none(),
        };
        judge.holds(same, || format!("sweep, {name}: {found:?}, the list has {wanted:?}"));
    };
    let of = |key: &str| main[key]["value"].as_f64();
    column("peak", of("peak"));
    column("rms", of("rms"));
    column("impacts_per_period", of("impacts_per_period"));
    column("efficiency", of("efficiency"));
    let speed = of("impact_speed");
    column("impact_speed", speed.or((main["kind"] == "rest").then_some(0.0)));
    column("repeats_after", main["repeats_after"].as_f64());
    column("share_of_starts", Some(number(&main["starts"]) / starts as f64));
    // What the criteria of the case leave out is left out of its sweep.
    let left_out = text.contains("count_inactive = false");
    let counting = || {
        motions.iter().filter(|one| {
            let rests = one["kind"] == "rest";
            let few = number(&one["starts"]) == 0.0 && number(&one["share"]) < 0.01;
            !(rests && (left_out || few))
        })
    };
    column("motions", Some(counting().count() as f64));
    let largest = counting().map(|one| number(&one["peak"]["value"])).fold(0.0, f64::max);
    column("largest_peak", Some(largest));
    let steady: Vec<&Value> = motions.iter().filter(|one| is_one_to_one(one)).collect();
    let reached = steady.iter().any(|one| number(&one["starts"]) > 0.0);
    let flag = match steady.is_empty() {
        true => "",
        false if reached => "true",
        false => "false",
    };
    let told = cell("orbit_reached").unwrap_or_default().to_owned();
    let peak = read("orbit_peak");
    judge.holds(
        told == flag || told.is_empty() && steady.iter().all(|one| one["kind"] != "orbit"),
        || format!("sweep, orbit_reached: {told:?}, the list has {flag:?}"),
    );
    if let Some(peak) = peak {
        let known =
            steady.iter().any(|one| (number(&one["peak"]["value"]) / peak - 1.0).abs() < SOLVED);
        judge.holds(known, || format!("sweep, orbit_peak: {peak} is not in the list"));
    }
    judge.holds(cell("regime") == main["regime"].as_str(), || {
        format!("sweep, regime: {:?}, the list has {}", cell("regime"), main["regime"])
    });
    let bare = number(&report["quantities"]["bare_peak"]["value"]);
    if let Some(reduction) = read("reduction_db") {
        let wanted = 20.0 * libm::log10(bare / largest);
        judge.near("sweep, reduction", reduction, wanted, 1e-6);
    }
    let _ = analysed;
}

/// Periods that a case measures.
fn periods(text: &str) -> u64 {
    let line = text.lines().find(|line| line.trim_start().starts_with("periods ="));
    let value =
        line.and_then(|line| line.split('=').nth(1)?.split('#').next()?.trim().parse().ok());
    value.unwrap_or(1000)
}

/// What a trade-off holds all layers against.
fn traded(judge: &mut Judge, bench: &Bench, motions: &[Value], simulated: &Value, report: &Value) {
    let Some(found) = bench.json("tradeoff", &[]) else {
        judge.holds(false, || "no trade-off".into());
        return;
    };
    let (Some(main), best) = (main_of(motions), &found["best"]) else { return };
    let clearance = number(&report["quantities"]["clearance"]["value"]);
    let rms = clearance * number(&best["rms_over_clearance"]);
    let listed = number(&main["rms"]["value"]);
    // Measured twice where it never repeats.
    let errors = number(&main["rms"]["error"]) + number(&best["rms_error"]) * rms;
    judge.near("trade-off, rms", rms, listed, 2.0 * errors + SOLVED * listed);
    judge.same("trade-off, share", &found["share"], &main["share"]);
    judge.near(
        "trade-off, others",
        number(&found["other_motions"]),
        motions.len() as f64 - 1.0,
        0.0,
    );
    judge.same("trade-off, regime", &best["regime"], &simulated["regime"]);
    let orbit = best["layer"] == "exact-orbit";
    judge.holds(orbit == (main["kind"] == "orbit"), || {
        format!("trade-off, {}: {}", best["layer"], main["kind"])
    });
}

/// The claim of an optimum is what `check` says of the file it wrote, and a second search rests there.
fn optimum(judge: &mut Judge, bench: &Bench) {
    let file = bench.at("optimum.toml");
    let name = file.to_str().expect("UTF-8");
    // Whatever it takes.
    let options = ["--objective", "worst-amplitude", "--write", name, "--long"];
    let Some(found) = bench.json("optimize", &options) else {
        judge.holds(false, || "no optimum".into());
        return;
    };
    let written = file.exists();
    judge.holds(written == (found["feasible"] == true && found["improves"] == true), || {
        format!(
            "written: {written}, but feasible {} and improves {}",
            found["feasible"], found["improves"]
        )
    });
    judge.same("optimum, claimed and checked", &found["claimed"], &found["checked"]);
    if !written {
        return;
    }
    let Some(checked) = bench.json_of("check", &file, &["--criteria-only"]) else { return };
    let checked = &checked["cases"][0];
    judge.same("optimum, holds", &checked["holds"], &found["feasible"]);
    let peak = criterion(checked, "peak_displacement").unwrap_or(&Value::Null);
    judge.same("optimum, claim and check", &found["claimed"]["value"], &peak["found"]);
    let [claimed, error] = ["value", "error"].map(|key| number(&found["claimed"][key]));
    judge.near("optimum, error of claim and check", error, number(&peak["error"]), SAME * claimed);
    let again = bench.json_of("optimize", &file, &["--objective", "worst-amplitude", "--long"]);
    let again = again.unwrap_or_default();
    judge.holds(again["answer"] == "own-is-best", || {
        format!(
            "optimize of its own result: {}, {} after {}",
            again["answer"], again["claimed"], found["claimed"]
        )
    });
}
