//! Texts without their numbers: the same sentence about another number is the same sentence.

/// The text with every number, its sign, its error and its power of ten taken out. Digits of a name stay,
/// as in `Z3`.
pub(super) fn skeleton(text: &str) -> String {
    let mut words: Vec<String> = Vec::new();
    let mut tokens = text.split_whitespace().peekable();
    while let Some(token) = tokens.next() {
        // What an average is known to may appear beside its number, or vanish.
        let token = if token == "±" {
            let error = tokens.next().unwrap_or("");
            tokens.next_if_eq(&"%");
            error
        } else {
            token
        };
        let word = without_numbers(token);
        // Punctuation moves from one number to the next word when an error appears between them.
        match words.last_mut() {
            Some(last) if !word.starts_with(|first: char| first.is_alphanumeric()) => {
                last.push_str(&word);
            }
            _ if word.is_empty() => {}
            _ => words.push(word),
        }
    }
    words.join(" ")
}

fn without_numbers(word: &str) -> String {
    let letters: Vec<char> = word.chars().collect();
    let digit = |index: usize| letters.get(index).is_some_and(char::is_ascii_digit);
    let sign = |index: usize| matches!(letters.get(index), Some('-' | '−' | '+'));
    let mut kept = String::new();
    let mut index = 0;
    while index < letters.len() {
        let named = kept.ends_with(char::is_alphabetic);
        if !named && (digit(index) || sign(index) && digit(index + 1)) {
            index += 1;
            while digit(index) || letters.get(index) == Some(&'.') && digit(index + 1) {
                index += 1;
            }
            let power = index + 1 + usize::from(sign(index + 1));
            if letters.get(index) == Some(&'e') && digit(power) {
                index = power;
                while digit(index) {
                    index += 1;
                }
            }
            continue;
        }
        kept.push(letters[index]);
        index += 1;
        // The other digits of a name.
        while named && digit(index) {
            kept.push(letters[index]);
            index += 1;
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::skeleton;

    #[test]
    fn only_the_words_are_left() {
        let same = [
            ("rms 4.03 mm ± 2.5 % instead", "rms 4.11 mm instead"),
            ("(z = 1.45 ± 0.08): peak", "(z = 1.4): peak"),
            ("change (−5.0 dB).", "change (+1.9 dB)."),
            ("misses itself by 2e-15", "misses itself by 9.5e−16"),
            ("100 % (89 % to 100 %)", "81 % (65 % to 91 %)"),
        ];
        for (old, new) in same {
            assert_eq!(skeleton(old), skeleton(new), "{old} | {new}");
        }
        let different = [
            ("the absorber works", "the absorber makes it worse"),
            ("unstable, largest multiplier 1.1", "stable, largest multiplier 0.9"),
            ("area Z3", "area Z4"),
            ("strip A2 of P12", "strip A2 of P13"),
            ("3.5 mm", "3.5 µm"),
        ];
        for (old, new) in different {
            assert_ne!(skeleton(old), skeleton(new), "{old} | {new}");
        }
    }
}
