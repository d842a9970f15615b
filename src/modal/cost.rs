//! What a search of absorbers or dampers makes small.

/// By how much limits are missed, of what they are about over what they allow: where all are met the largest, else 1 and the
/// logarithms of those above 1: a design that misses a limit which none meets is still better the more of the others it meets.
pub(super) fn cost(over: &[f64]) -> f64 {
    let missed = over.iter().filter(|one| **one > 1.0).map(|one| libm::log(*one));
    let missed: f64 = missed.sum();
    if missed > 0.0 { 1.0 + missed } else { over.iter().copied().fold(0.0, f64::max) }
}

#[cfg(test)]
mod tests {
    use super::cost;

    #[test]
    fn what_nothing_meets_leaves_the_others_their_say() {
        // Of limits that are met the tightest, of one alone its own order.
        assert_eq!(cost(&[0.3, 0.9]), 0.9);
        let order = [0.2, 0.99, 1.0, 1.01, 5.0, f64::INFINITY].map(|one| cost(&[one]));
        assert!(order.windows(2).all(|pair| pair[0] < pair[1]), "{order:?}");
        // One that is eleven times too much: the better design is that which meets the other.
        assert!(cost(&[11.0, 0.9]) < cost(&[10.9, 1.5]));
    }
}
