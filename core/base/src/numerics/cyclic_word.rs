//! Closed sequences of two kinds of beads: one name for all that differ by where they are said to
//! begin or by which kind is called which.

/// The canonical form of a closed sequence of beads: the first in the order of a dictionary, `false`
/// before `true`, among all rotations of it and of its mirror image, in which every bead is of the
/// other kind. As long as `beads`; empty for no beads.
pub fn canonical(beads: &[bool]) -> Vec<bool> {
    let count = beads.len();
    let word = |from: usize, mirrored: bool| {
        (0..count).map(move |k| beads[(from + k) % count] != mirrored)
    };
    let candidates = (0..count).flat_map(|from| [(from, false), (from, true)]);
    let first = candidates.min_by(|a, b| word(a.0, a.1).cmp(word(b.0, b.1)));
    first.map_or_else(Vec::new, |(from, mirrored)| word(from, mirrored).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every sequence of up to 10 beads against the definition: it shares its form with all its
    /// rotations and its mirror image, and the form is one of them and not after any.
    #[test]
    fn the_form_is_the_first_of_all_that_it_stands_for() {
        for count in 1..=10_usize {
            for bits in 0..1_u32 << count {
                let beads: Vec<bool> = (0..count).map(|k| bits >> k & 1 == 1).collect();
                let form = canonical(&beads);
                let mut turned = beads.clone();
                let mut met = false;
                for _ in 0..count {
                    turned.rotate_left(1);
                    let mirrored: Vec<bool> = turned.iter().map(|bead| !bead).collect();
                    for other in [&turned, &mirrored] {
                        assert_eq!(canonical(other), form);
                        assert!(form <= *other);
                        met |= form == *other;
                    }
                }
                assert!(met, "{beads:?} {form:?}");
            }
        }
        assert!(canonical(&[]).is_empty());
    }

    /// Read backwards is another motion: time has a direction.
    #[test]
    fn a_reversed_sequence_is_another_one() {
        let beads = [false, false, true, false, true, true, true, true];
        let mut reversed = beads;
        reversed.reverse();
        assert_ne!(canonical(&beads), canonical(&reversed));
    }
}
