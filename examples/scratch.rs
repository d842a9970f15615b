use vinesink::case::Case; use vinesink::study::*;
fn main(){
 for p in std::env::args().skip(1) {
  let case=Case::parse(&p,&std::fs::read_to_string(&p).unwrap()).unwrap();
  let t=std::time::Instant::now();
  let sys=case.system();
  let s=CaseStudy::of(&sys,StudyEffort::default(),&mut |_|()).unwrap();
  println!("== {p} {:?} area {:?} zone {:?}",t.elapsed(),s.area,s.analysis.zone);
  for f in &s.analysis.fixed_points { println!("  fp B {:.4} C {:.4} eta {:.3} {:?} tr {:.3} det {:.3} {:?} stable {} res {:.1e} wmax {:.3}",f.absorber,f.oscillator,f.eta,f.branch,f.trace,f.determinant,f.kind,f.stable,f.residual,f.largest_relative_displacement); }
  for a in &s.attractors { let e=a.attractor.classification.evidence; println!("  att {:?} {} theory {} z={:.3} {:?} mod {:.3} settled {} peak {:.4} cap {:.3}",a.regime(),a.starts,a.reached_from_theory,e.impacts_per_period,e.periodicity.map(|p|(p.impacts,p.periods)),e.modulation_depth,e.settled,case.scales().length(a.attractor.peak)*1e3,e.captures.share); }
  for c in &s.claims { println!("  claim {} | {:?} | {:?} | {:?} tol {:.3} {:?}",c.statement,c.predicted,c.observed,c.difference,c.tolerance.value,c.verdict); }
  for m in &s.margins.clearance { println!("  margin {:?} {:?} {:.3} ends {}",m.kind,m.branch,m.factor,m.ends_steady_resonance); }
  println!("  freq {:?}",s.margins.frequency);
  let om=sys.frequency_ratio(); let t=std::time::Instant::now();
  let fs:Vec<f64>=(0..13).map(|k| 0.9+0.02*k as f64).collect();
  let g=scenes::grazing_line(&sys,&fs).unwrap(); println!("  grazing {:?} {:?}",t.elapsed(),g.iter().map(|p|(p.frequency_ratio,p.clearance*case.scales().clearance*1e3)).collect::<Vec<_>>());
  let t=std::time::Instant::now();
  let g=scenes::sweep(&sys,&fs).unwrap(); println!("  sweep {:?} {:?}",t.elapsed(),g.iter().map(|p|(p.regime,p.peak)).collect::<Vec<_>>()); let _=om;
 }}
