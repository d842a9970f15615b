//! How well an average is known from its scatter.

/// Twice the standard error of the mean of `blocks`, averages over stretches of equal length; infinite
/// for fewer than two. Stretches shorter than a motion remembers make it too small.
pub fn twice_standard_error(blocks: &[f64]) -> f64 {
    let count = blocks.len() as f64;
    if count < 2.0 {
        return f64::INFINITY;
    }
    let mean = blocks.iter().sum::<f64>() / count;
    let squares: f64 = blocks.iter().map(|block| (block - mean) * (block - mean)).sum();
    2.0 * (squares / (count - 1.0) / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::twice_standard_error;

    #[test]
    fn the_error_is_that_of_a_mean() {
        // Variance 5/3 of four numbers: the mean's is a quarter of it.
        let error = twice_standard_error(&[1.0, 2.0, 3.0, 4.0]);
        assert!((error - 2.0 * (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
        assert_eq!(twice_standard_error(&[7.0; 10]), 0.0);
        assert_eq!(twice_standard_error(&[7.0]), f64::INFINITY);
    }
}
