use vinesink::extremes::*; use vinesink::system::*; use vinesink::simulation::*;
fn main(){
 let eps=0.032/4.168; let w0=(11.47e3_f64/4.168).sqrt();
 let base=Parameters{mass_ratio:eps,damping:3.02/(0.032*w0),restitution:0.6,frequency_ratio:8.0*std::f64::consts::TAU/w0,forcing_per_clearance:0.25/eps/7.5,excitation:Excitation::BaseDisplacement};
 let start=State{x:0.25,x_velocity:0.3,y:-0.4,y_velocity:0.6};
 let mut rows:Vec<(String,Parameters,u64)>=vec![("base".into(),base,200)];
 for r in [0.0,1e-9,0.05,0.999999,1.0]{rows.push((format!("r {r}"),Parameters{restitution:r,..base},200));}
 for e in [1e-9,1e-6,1e-3,0.1,0.9]{rows.push((format!("eps {e}"),Parameters{mass_ratio:e,..base},200));}
 for l in [0.0,1e-3,10.0,100.0,1e3]{rows.push((format!("lambda {l}"),Parameters{damping:l,..base},200));}
 rows.push(("critical".into(),Parameters{mass_ratio:0.0078125,damping:256.0,..base},200));
 for g in [1e-8,1e-4,1.0,1e2,1e4,1e6,1e8]{rows.push((format!("gamma {g}"),Parameters{forcing_per_clearance:g,..base},200));}
 for o in [1e-3,1e-1,1.0,10.0,1e3]{rows.push((format!("Omega {o}"),Parameters{frequency_ratio:o,..base},if o<0.01{5}else if o>100.0{2000}else{200}));}
 rows.push(("undamped resonance".into(),Parameters{frequency_ratio:1.0,damping:0.0,..base},200));
 for r in [0.6,0.95,0.99,0.999,0.999999,1.0]{rows.push((format!("b0.3 r {r}"),Parameters{restitution:r,forcing_per_clearance:0.25/eps/0.3,..base},200));}
 rows.push(("corner".into(),Parameters{mass_ratio:0.9,damping:1e3,frequency_ratio:1e3,..base},200));
 rows.push(("corner2".into(),Parameters{forcing_per_clearance:1e8,restitution:0.999999,..base},200));
 rows.push(("corner3".into(),Parameters{mass_ratio:0.9,damping:1e3,..base},200));
 rows.push(("corner4".into(),Parameters{mass_ratio:0.9,damping:1e3,forcing_per_clearance:1e8,frequency_ratio:1e-3,..base},5));
 rows.push(("corner5".into(),Parameters{mass_ratio:1e-9,forcing_per_clearance:1e8,..base},200));
 for (name,p,periods) in rows{ let t=std::time::Instant::now();
  let system=System::new(p).unwrap();
  let mut run=Run{system,start,periods,impact_limit:200_000,followed:0,tolerance:ContactTolerance::default()};
  run.measure().unwrap(); let a=t.elapsed().as_secs_f64();
  run.followed=40; run.periods=periods; let m=run.measure().unwrap();
  let b=t.elapsed().as_secs_f64()-a;
  println!("{name:20} {:?} z {:.3e} ev/p {:.2e} c {} E {:.1e} pen {:.1e} peak {:.2e} doubts {} {:.2}s|{:.2}s {:?}",m.stop,m.impacts as f64/m.periods.max(1) as f64,m.evaluations as f64/m.periods.max(1) as f64,m.contacts,m.energy_residual,m.penetration,m.peak,m.doubts.len(),a,b,m.comparison.map(|c|(c.events,c.same_order,format!("{:.1e} one {:.1e} clock {:.1e} last {:.2}",c.error,c.one_rounding,c.clock,c.last))));
 }
}
