use vinesink::system::*; use vinesink::regimes::attractor::*; use vinesink::study::attractors::*;
fn main(){
 let w0=(11470.0f64/4.168).sqrt(); let eps=0.032/4.168; let lam=3.02/(0.032*w0);
 let args:Vec<f64>=std::env::args().skip(1).map(|a|a.parse().unwrap()).collect();
 let list:Vec<(f64,f64)>= if args.len()>1 {args[1..].iter().map(|b|(args[0],*b)).collect()} else {vec![(8.0,0.3),(8.0,2.5),(8.,4.),(8.,7.5),(8.,11.5),(8.,15.),(8.,16.4),(8.,20.)]};
 for (f,b) in list {
  let om=f*std::f64::consts::TAU/w0;
  let sys=System::new(Parameters{mass_ratio:eps,damping:lam,restitution:0.6,frequency_ratio:om,forcing_per_clearance:0.25/eps/b,excitation:Excitation::BaseDisplacement}).unwrap();
  let t=std::time::Instant::now();
  let a=find(&sys,&[],&SearchEffort{starts:32,each:Effort{discard:400,periods:200,prolongations:4,impact_limit:1_000_000},measured:1000},&mut |_|()).unwrap();
  println!("f{f} b{b} {:?}",t.elapsed());
  for x in a { let e=x.attractor.classification.evidence; println!("   {:?} n={} z={:.4} {:?} asym={:.4} mod={:.3} cap={:?} settled={} peak={:.3} rms={:.4}", x.attractor.classification.regime,x.starts,e.impacts_per_period,e.periodicity.map(|p|(p.impacts,p.periods)),e.asymmetry,e.modulation_depth,(e.captures.count,e.captures.share,e.captures.longest),e.settled,x.attractor.peak*b,x.attractor.rms*b); }
 }}
