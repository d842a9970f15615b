//! Gauss-Legendre quadrature on short panels.

/// Positive nodes and weights of the eight-point Gauss-Legendre rule on `[-1, 1]`
/// (Abramowitz and Stegun, table 25.4). Exact for polynomials of degree 15.
const NODES: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Calls `visit(s, weight)` for the nodes of `[from, to]`, cut into panels no longer than `panel`,
/// in a fixed order.
///
/// With a panel of an eighth of the shortest period involved the rule is exact to rounding for
/// products of two sinusoids.
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
    use super::nodes;

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
    fn panels_integrate_a_squared_sine_to_rounding() {
        let mut sum = 0.0;
        nodes(0.0, std::f64::consts::TAU, 0.785, |s, weight| {
            sum += weight * libm::sin(s) * libm::sin(s);
        });
        assert!((sum - std::f64::consts::PI).abs() < 1e-14, "{sum}");
    }
}
