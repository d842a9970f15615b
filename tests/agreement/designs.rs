//! Designs that are put to the program: shipped ones, those on which commands used to contradict one another, and generated
//! ones.

use crate::random::Random;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// A case with its name.
pub struct Design {
    pub name: String,
    pub text: String,
    /// Of a generated one.
    pub number: Option<usize>,
}

/// The cases of the program that are driven steadily.
pub fn shipped() -> Vec<Design> {
    let mut all = folder("cases");
    all.retain(|one| {
        let steady = ["\"base-displacement\"", "\"force\"", "[reduced]"];
        let other = ["\"sine-sweep\"", "\"record\"", "\"free\"", "\"impulse\""];
        steady.iter().any(|kind| one.text.contains(kind))
            && !other.iter().any(|kind| one.text.contains(&format!("kind = {kind}")))
    });
    all
}

/// Those on which commands used to contradict one another.
pub fn known() -> Vec<Design> {
    folder("tests/agreement/one-answer")
}

fn folder(path: &str) -> Vec<Design> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let entries = fs::read_dir(folder).expect("a folder");
    let files = entries.map(|entry| entry.expect("an entry").path());
    let cases = files.filter(|file| file.extension().is_some_and(|end| end == "toml"));
    let mut all: Vec<Design> = cases
        .map(|file| Design {
            name: file.file_stem().expect("a name").to_string_lossy().into_owned(),
            text: fs::read_to_string(&file).expect("a text"),
            number: None,
        })
        .collect();
    all.sort_by(|a, b| a.name.cmp(&b.name));
    all
}

/// Structures of 1 to 500 Hz, driven near resonance by a force or their base, whose absorbers have clearances from below the
/// fold of the manifold to where impacts end; a third in a real cavity, a third with a band.
pub fn generated(seed: u64, count: usize) -> Vec<Design> {
    (0..count).map(|number| design(seed, number)).collect()
}

/// Structures of two or three modes with one or two absorbers, driven near one of their modes by a force or their base, at one frequency
/// or over a range.
pub fn of_several(seed: u64, count: usize) -> Vec<Design> {
    (0..count).map(|number| several(seed, number)).collect()
}

fn several(seed: u64, number: usize) -> Design {
    let mut random = Random(seed.wrapping_mul(1_000_033).wrapping_add(number as u64));
    let first = random.ratio(0.5, 200.0);
    let modes = 2 + usize::from(random.one_in(2.0));
    let absorbers = 1 + usize::from(random.one_in(2.0));
    let frequencies: Vec<f64> = (0..modes).map(|k| first * (1.0 + 2.3 * k as f64)).collect();
    let driven = usize::from(random.one_in(3.0));
    let zeta = random.ratio(0.004, 0.02);
    let natural = frequencies[driven];
    let omega = std::f64::consts::TAU * natural;
    // What the driven mode does alone at its resonance, over the displacement that gravity gives.
    let alone = random.ratio(1e-3, 0.1) * 9.81 / (omega * omega);
    let mut text = format!("title = \"design {number} of {seed}\"\nsource = \"generated\"\n");
    let mut line = |line: String| writeln!(text, "{line}").expect("written");
    for frequency in &frequencies {
        let other = random.within(-1.0, 1.0);
        line(format!(
            "[[mode]]\nfrequency = \"{frequency:.6} Hz\"\ndamping_ratio = {zeta:.5}\nmass = \"10 kg\"\nparticipation = 1\n\
             shape = {{ tip = 1, other = {other:.4} }}"
        ));
    }
    for j in 0..absorbers {
        let (mass, clearance) = (random.ratio(0.05, 0.8), alone * random.ratio(0.3, 5.0));
        let (place, restitution) = (["tip", "other"][j], random.within(0.2, 0.9));
        line(format!(
            "[[absorber]]\nplace = \"{place}\"\nmass = \"{mass:.5} kg\"\nclearance = \"{clearance:.6e} m\"\nrestitution = {restitution:.4}"
        ));
    }
    line(String::from("[excitation]"));
    if random.one_in(3.0) {
        line(format!("kind = \"base-displacement\"\namplitude = \"{:.6e} m\"", 2.0 * zeta * alone));
    } else {
        let force = 10.0 * omega * omega * 2.0 * zeta * alone;
        line(format!("kind = \"force\"\nplace = \"tip\"\namplitude = \"{force:.6e} N\""));
    }
    match number % 3 {
        0 => {
            line(format!("from = \"{:.6} Hz\"\nto = \"{:.6} Hz\"", 0.98 * natural, 1.03 * natural))
        }
        _ => line(format!("frequency = \"{:.6} Hz\"", natural * random.within(0.98, 1.02))),
    }
    line(String::from("[criteria]"));
    if random.one_in(4.0) {
        line(String::from("count_inactive = false"));
    }
    let mut part = || random.ratio(0.2, 1.5);
    line(format!("peak_displacement = \"<= {:.6e} m\"", part() * alone));
    line(format!("rms_displacement = \"<= {:.6e} m\"", 0.7 * part() * alone));
    line(format!("impact_velocity = \"<= {:.6e} m/s\"", 3.0 * part() * alone * omega));
    line(format!("reduction_db = \">= {:.3}\"", 6.0 * part() - 2.0));
    line(String::from("no_coexistence = true"));
    Design { name: format!("several-{seed}-{number}"), text, number: Some(number) }
}

fn design(seed: u64, number: usize) -> Design {
    let mut random = Random(seed.wrapping_mul(1_000_003).wrapping_add(number as u64));
    let (mass, natural) = (random.ratio(1.0, 2000.0), random.ratio(1.0, 500.0));
    let (eps, zeta) = (random.ratio(0.003, 0.03), random.ratio(0.001, 0.02));
    let restitution = random.within(0.2, 0.9);
    let sigma = random.within(-5.0, 4.0);
    let frequency = natural * (1.0 + (eps * sigma).clamp(-0.08, 0.08));
    let base = random.one_in(2.0);
    let omega0 = std::f64::consts::TAU * natural;
    let stiffness = mass * omega0 * omega0;
    // A static displacement of a thousandth of what gravity gives.
    let still = random.ratio(1e-4, 1e-2) * 9.81 / (omega0 * omega0);
    let omega = frequency / natural;
    let loss = 2.0 * zeta * omega;
    let denominator = libm::hypot(1.0 - omega * omega, loss);
    let alone = if base { libm::hypot(1.0, loss) } else { 1.0 } * still / denominator;
    let reduced = still / eps;
    let clearance = random.ratio(reduced / 12.0, (1.3 * alone).max(reduced / 6.0));
    let mut text = format!(
        "title = \"design {number} of {seed}\"\nsource = \"generated\"\n\n[oscillator]\nmass = \"{mass:.6} kg\"\n\
         frequency = \"{natural:.6} Hz\"\ndamping_ratio = {zeta:.6}\n\n[absorber]\nmass_ratio = {eps:.6}\n\
         clearance = \"{clearance:.6e} m\"\n"
    );
    let real = random.one_in(3.0);
    let kind = (3.0 * random.next()) as usize;
    let mut line = |line: String| writeln!(text, "{line}").expect("written");
    if real && kind == 0 {
        let apart = random.within(0.01, 0.08);
        line(format!("restitution = [{:.4}, {:.4}]", restitution + apart, restitution - apart));
    } else {
        line(format!("restitution = {restitution:.4}"));
    }
    // Acceleration of the absorber in units of gravity: what tilt and friction compete with.
    let acceleration = clearance * omega0 * omega0 / 9.81;
    if real && kind == 1 {
        let sine = (random.ratio(1e-3, 0.2) * acceleration).min(0.5);
        let tilt = libm::asin(sine).to_degrees();
        line(format!("inclination = \"{tilt:.6} deg\""));
    }
    if real && kind == 2 {
        line(format!("friction = {:.6}", (random.ratio(1e-3, 0.1) * acceleration).min(0.5)));
    }
    line(String::from("\n[excitation]"));
    if base {
        line(format!("kind = \"base-displacement\"\namplitude = \"{still:.6e} m\""));
    } else {
        line(format!("kind = \"force\"\namplitude = \"{:.6e} N\"", still * stiffness));
    }
    line(format!("frequency = \"{frequency:.6} Hz\""));
    if random.one_in(3.0) {
        let [below, above] = [random.within(0.0, 0.02), random.within(0.001, 0.02)];
        let ends = [frequency * (1.0 - below), frequency * (1.0 + above)];
        line(format!("\n[band]\nfrom = \"{:.6} Hz\"\nto = \"{:.6} Hz\"", ends[0], ends[1]));
    }
    line(String::from("\n[criteria]"));
    if random.one_in(4.0) {
        line(String::from("count_inactive = false"));
    }
    let mut part = || random.ratio(0.2, 1.5);
    line(format!("peak_displacement = \"<= {:.6e} m\"", part() * alone));
    line(format!("rms_displacement = \"<= {:.6e} m\"", 0.7 * part() * alone));
    line(format!("impact_velocity = \"<= {:.6e} m/s\"", 3.0 * part() * clearance * omega0));
    line(format!("reduction_db = \">= {:.3}\"", 6.0 * part() - 2.0));
    line(String::from("no_coexistence = true\nstable_share = \">= 50 %\""));
    Design { name: format!("generated-{seed}-{number}"), text, number: Some(number) }
}
