//! explore
use vinesink::case::Case;
use vinesink::executor::Serial;
use vinesink::transient::SweepStudy;
#[test]
fn explore() {
    for text in
        [include_str!("../../cases/sweep-slow.toml"), include_str!("../../cases/sweep-fast.toml")]
    {
        let case = Case::parse("c", text).unwrap();
        let t = std::time::Instant::now();
        let study = SweepStudy::of_case(&case, &Serial).unwrap().unwrap();
        let hz = |r: f64| case.scales().frequency(r);
        println!("time {:?} n {}", t.elapsed(), study.sweep.count());
        for (w, p) in &study.starts {
            println!(
                "{w:.3} peak {:.4}@{:.3} imp {} speed {:.3} res {:.1e}",
                p.peak()[1],
                hz(p.peak()[0]),
                p.impacts,
                p.impact_speed,
                p.residual
            );
        }
        println!(
            "back {:?} alone {:?} damped {:?} stroke {}",
            study.back.peak(),
            study.alone.peak(),
            study.damped.1.peak(),
            study.damped.1.stroke
        );
        for j in &study.jumps {
            for j in j {
                println!("jump {:.3} {:?}", hz(j.at), j.levels);
            }
            println!("--");
        }
        println!("differ {:?}", study.differ.map(|d| d.map(hz)));
        for r in &study.by_rate {
            println!("{:?} {:?}", r.sweep.rate, r.peaks);
        }
        let up = &study.worst().unwrap().1.envelope;
        let down = &study.back.envelope;
        let step = up.len() / 40 + 1;
        for k in (0..up.len()).step_by(step) {
            let m = |e: &[[f64; 2]], k: usize| {
                e[k..(k + step).min(e.len())].iter().map(|o| o[1]).fold(0.0, f64::max)
            };
            let f = up[k][0];
            let o = down.iter().position(|d| d[0] < f).unwrap_or(0);
            println!(
                "{:.3} up {:.3} down {:.3} alone {:.3}",
                hz(f),
                m(up, k),
                m(down, o.saturating_sub(step)),
                m(&study.alone.envelope, k)
            );
        }
    }
}
