//! The live page in Chromium beside the same work in this process: `web/build` first. Prints
//!
//! - the time of a frame while a slider moves (the case rewritten and read, theory, exact orbits, the manifold drawn)
//!   over that of the same calls here,
//! - the running simulation's time per impact over that of the engine here,
//! - frames a second while a slider moves, by the browser's own trace,
//! - when the first figure stands on the page, from a server on this machine.
//!
//! Nothing here asserts a time.

#[path = "../tests/program/browser_support/chromium.rs"]
#[allow(dead_code)]
mod chromium;

use std::hint::black_box;
use std::io::{Read as _, Write as _};
use std::net::TcpListener;
use std::path::Path;
use std::time::{Duration, Instant};

use chromium::{Browser, Page, View};
use serde_json::{Value, json};
use vinesink::case::{Case, Rounding};
use vinesink::report::{figure, figures, template};
use vinesink::simulation::{Simulation, Trace};
use vinesink::study::CaseStudy;
use vinesink::study::plots::Plot;
use vinesink::system::{Parameter, State};

const CASE: &str = include_str!("../cases/li2016-8p5hz-fig4c.toml");
const LIVE: &str = "document.querySelector('[data-live]').live";
/// Frames that are measured, and periods of the simulation.
const FRAMES: u32 = 200;
const PERIODS: u32 = 20_000;

fn main() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/web/live.html");
    let (Some(program), Ok(page)) = (chromium::program(), std::fs::read(&file)) else {
        println!("the live page is measured where there is Chromium and `web/build` was run");
        return;
    };
    let mut browser = Browser::start(&program);
    let view = View { width: 1440, height: 900, phone: false, dark: false };
    let mut tab = browser.page(view);
    tab.open_address(&serve(page));
    let first = tab.evaluate(&format!(
        "(async () => {{
            while (!document.querySelector('[data-live] figure svg')) await new Promise((done) => setTimeout(done, 1));
            const first = performance.now();
            await {LIVE}.settled();
            return first;
        }})()"
    ));
    println!(
        "first figure {:.0} ms after the address was opened",
        first.as_f64().unwrap_or(f64::NAN)
    );
    frames(&mut tab);
    simulation(&mut tab);
}

/// The address of a page that is served once.
fn serve(page: Vec<u8>) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = listener.local_addr().expect("an address");
    std::thread::spawn(move || {
        for stream in listener.incoming() {
            let Ok(mut stream) = stream else { continue };
            let _ = stream.read(&mut [0; 4096]);
            let head = format!(
                "HTTP/1.1 200 OK\r\nContent-Type: text/html; charset=utf-8\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
                page.len()
            );
            let _ = stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(&page));
        }
    });
    format!("http://{address}/")
}

/// Clearances of a slider that goes to and fro, in metres.
fn clearance(k: u32) -> f64 {
    0.02 + 0.005 * (f64::from(k) / 20.0).sin()
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

fn frames(tab: &mut Page) {
    let slide = format!(
        "(async () => {{
            {LIVE}.frames.length = 0;
            const slider = document.querySelector('#live-clearance');
            const begin = performance.now();
            for (let k = 0; k < {FRAMES}; k += 1) {{
                slider.value = 500 + 120 * Math.sin(k / 20);
                slider.dispatchEvent(new Event('input'));
                await new Promise(requestAnimationFrame);
            }}
            return [{LIVE}.frames, performance.now() - begin];
        }})()"
    );
    // A browser compiles often used code once more.
    tab.evaluate(&slide);
    let (measured, trace) = tab.traced(&slide);
    let times: Vec<f64> =
        measured[0].as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
    let seconds = measured[1].as_f64().unwrap_or(f64::NAN) / 1e3;
    let drawn = trace.iter().filter(|event| event["name"] == "DrawFrame").count();
    let here = median((0..FRAMES).map(frame).collect());
    let page = median(times.clone());
    let worst = times.iter().copied().fold(0.0, f64::max);
    println!(
        "a frame: {page:.2} ms in the page (slowest {worst:.1}), {here:.2} ms here: ratio {:.2}",
        page / here
    );
    println!("{:.0} frames a second are drawn while the slider moves", drawn as f64 / seconds);
}

/// What the page computes for a frame, ms.
fn frame(k: u32) -> f64 {
    let begin = Instant::now();
    let case = Case::parse("case.toml", CASE).expect("valid");
    let design = case.design.with(Parameter::Clearance, clearance(k));
    let changed = case.rewritten("case.toml", CASE, &design, Rounding::Nearest).expect("valid");
    let sketch = CaseStudy::sketch(&changed.case.system()).expect("a theory");
    let drawn = figures::all(&changed.case, &sketch, &[Plot::Manifold]);
    for figure in template::worded(drawn, &changed.case.units()).expect("words") {
        black_box(figure::draw(&figure).expect("a drawing"));
    }
    begin.elapsed().as_secs_f64() * 1e3
}

fn simulation(tab: &mut Page) {
    let measured = tab.evaluate(&format!(
        "(() => {{
            const engine = {LIVE}.engine();
            engine.ask({{ ask: 'run', text: {}, from: 'push' }});
            engine.goOn(1000, 1);
            let best = Infinity, impacts = 0;
            for (let k = 0; k < 7; k += 1) {{
                const begin = performance.now();
                impacts = engine.goOn({PERIODS}, 1).impacts.length / 3;
                best = Math.min(best, performance.now() - begin);
            }}
            return [best, impacts];
        }})()",
        json!(CASE)
    ));
    let of = |k: usize| measured[k].as_f64().unwrap_or(f64::NAN);
    let system = Case::parse("case.toml", CASE).expect("valid").system();
    let start = State { y: 0.5, y_velocity: 1.0, ..State::AT_REST };
    let mut simulation = Simulation::new(&system, start, 0.0).expect("inside");
    simulation.run(1000, 100_000, &mut Trace::new(1.0));
    let (mut best, mut impacts) = (Duration::MAX, 0);
    for _ in 0..7 {
        let begin = Instant::now();
        let mut trace = Trace::new(1.0);
        simulation.run(PERIODS.into(), 100_000, &mut trace);
        (best, impacts) = (best.min(begin.elapsed()), trace.impacts.len());
    }
    let here = best.as_secs_f64() * 1e9 / impacts as f64;
    let page = of(0) * 1e6 / of(1);
    println!(
        "an impact of the running simulation: {page:.0} ns in the page, {here:.0} ns here: speed {:.2}",
        here / page
    );
}
