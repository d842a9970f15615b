use super::tests::simulations;
use super::*;
#[test]
fn dbg() {
    let (mut a, mut b) = (simulations(), simulations());
    let n = a.len();
    run(&mut a, 3, u64::MAX, &mut vec![(); n]);
    for s in &mut b {
        s.run(3, u64::MAX, &mut ());
    }
    for (p, q) in a.iter().zip(&b) {
        if format!("{:?}", p.stand) != format!("{:?}", q.stand) {
            println!("{:?}\n{:?}\n", p.stand, q.stand);
        }
    }
}
