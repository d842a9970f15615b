use vinesink::simulation::*; use vinesink::system::*;
fn main(){
 let w0=(11470.0f64/4.168).sqrt(); let eps=0.032/4.168; let lam=3.02/(0.032*w0);
 for (f,b) in [(8.0,0.3),(8.0,2.5),(8.,4.),(8.,7.5),(8.,11.5),(8.,15.),(8.,16.4),(8.,20.),(8.5,2.),(8.5,5.),(8.5,20.),(8.5,28.),(8.5,45.),(w0/std::f64::consts::TAU,11.5),(w0/std::f64::consts::TAU,7.5)] {
  let om=f*std::f64::consts::TAU/w0;
  let sys=System::new(Parameters{mass_ratio:eps,damping:lam,restitution:0.6,frequency_ratio:om,forcing_per_clearance:0.25/eps/b,excitation:Excitation::BaseDisplacement}).unwrap();
  let t=std::time::Instant::now();
  let start=State{x:0.,x_velocity:0.01,y:0.,y_velocity:0.};
  let start= if f==8.0 && b==16.4 {State{x:0.1,x_velocity:0.2,y:0.,y_velocity:0.4}} else {start};
  let mut sim=Simulation::new(&sys,start,0.).unwrap();
  sim.run(1000,10_000_000,&mut vinesink::simulation::run::Nobody);
  let tr=t.elapsed();
  let mut st=Statistics::begin(&sys,sim.state());
  let stop=sim.run(1000,10_000_000,&mut st);
  println!("f{f:.4} b{b} z={:.4} peak={:.4}mm rms={:.4} {:?} contact {:?} pen {:.1e} stop {stop:?} ev/imp {:.1} t={:?}+{:?} lin {:.3}", st.impacts_per_period(), st.peak()*b, st.rms(), st.energy().relative_residual, st.sustained_contact(), st.penetration(), sim.evaluations() as f64/sim.impacts() as f64, tr, t.elapsed()-tr, sys.linear_response().unwrap().amplitude()*b);
 }}
