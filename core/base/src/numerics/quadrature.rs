//! Gauss-Legendre quadrature on short panels.

/// Positive nodes and weights of the eight-point Gauss-Legendre rule on `[-1, 1]`
/// (Abramowitz and Stegun, table 25.4). Exact for polynomials of degree 15.
const NODES: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Calls `visit(s, weight)` for the nodes of `[0, to]`, cut into panels, in a fixed order.
///
/// Panels are no longer than `longest`. Near 0 they are no longer than `first`, and they grow by a
/// third each: that resolves a part that decays within a few `first` without paying for it later.
/// With a longest panel of an eighth of the shortest period involved the rule is exact to rounding
/// for products of two sinusoids.
pub fn graded_nodes(to: f64, first: f64, longest: f64, mut visit: impl FnMut(f64, f64)) {
    let mut from = 0.0;
    while first < longest && from < to {
        let length = first.max(from / 3.0);
        if length >= longest {
            break;
        }
        let end = (from + length).min(to);
        nodes(from, end, longest, &mut visit);
        from = end;
    }
    nodes(from, to, longest, visit);
}

/// Calls `visit(s, weight)` for the nodes of `[from, to]`, cut into equal panels no longer than
/// `panel`, in a fixed order.
pub fn nodes(from: f64, to: f64, panel: f64, mut visit: impl FnMut(f64, f64)) {
    let length = to - from;
    if length <= 0.0 {
        return;
    }
    let panels = (length / panel).ceil().max(1.0);
    let half = 0.5 * length / panels;
    let mut centre = from + half;
    for _ in 0..panels as u64 {
        for (node, weight) in NODES {
            visit(centre - half * node, half * weight);
            visit(centre + half * node, half * weight);
        }
        centre += 2.0 * half;
    }
}

#[cfg(test)]
mod tests {
    use super::{graded_nodes, nodes};

    #[test]
    fn the_rule_is_exact_for_degree_fifteen() {
        let mut sum = 0.0;
        nodes(0.0, 1.0, 10.0, |s, weight| sum += weight * libm::pow(s, 15.0));
        assert!((sum - 1.0 / 16.0).abs() < 1e-15, "{sum}");
        let mut sum = 0.0;
        nodes(0.0, 1.0, 10.0, |s, weight| sum += weight * libm::pow(s, 16.0));
        assert!((sum - 1.0 / 17.0).abs() > 1e-12, "degree 16 should show the rule's error");
    }

    #[test]
    fn graded_panels_integrate_a_fast_decay_to_rounding_with_few_nodes() {
        let (rate, mut sum, mut count) = (1000.0, 0.0, 0);
        graded_nodes(6.0, 0.5 / rate, 0.785, |s, weight| {
            count += 1;
            sum += weight * (rate * libm::exp(-rate * s) + libm::sin(s));
        });
        let exact = 1.0 + 1.0 - libm::cos(6.0);
        assert!((sum - exact).abs() < 1e-14, "{sum} {exact}");
        assert!(count < 400, "{count}");
    }

    #[test]
    fn panels_integrate_a_squared_sine_to_rounding() {
        let mut sum = 0.0;
        nodes(0.0, std::f64::consts::TAU, 0.785, |s, weight| {
            sum += weight * libm::sin(s) * libm::sin(s);
        });
        assert!((sum - std::f64::consts::PI).abs() < 1e-14, "{sum}");
    }
}
