//! How wide words are, without a font at hand, and how they are written into SVG.

use std::collections::BTreeMap;

use super::geometry::{Point, Rect};

/// The fonts asked for; all have close to Helvetica's widths but for the generic one at the end.
pub(super) const FAMILY: &str = "Helvetica, Arial, Liberation Sans, sans-serif";
/// Tick labels, direct labels and legends, pixels.
pub(super) const SMALL: f64 = 14.0;
/// Axis labels and headings, pixels.
pub(super) const LARGE: f64 = 15.0;
/// Widths are multiplied by this, for the fonts that run wider than Helvetica.
const CAUTION: f64 = 1.1;

/// Helvetica's advance widths from space to tilde, in thousandths of the font size.
const WIDTHS: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];

/// Width of bold words over that of others: Helvetica's are 1.06, those of DejaVu Sans, which stands in for it on
/// many machines, 1.12.
const BOLD: f64 = 1.12;

/// A cautious estimate of the width of words, pixels.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let thousandths: u32 = text
        .chars()
        .map(|c| match c {
            ' '..='~' => u32::from(WIDTHS[c as usize - ' ' as usize]),
            '\u{2070}'..='\u{209c}' | '\u{b2}' | '\u{b3}' | '\u{b9}' => 370,
            '\u{300}'..='\u{36f}' => 0,
            '\u{2212}' | '\u{d7}' | '\u{b1}' => 584,
            '\u{b7}' | '\u{3b9}' => 333,
            '\u{370}'..='\u{3ff}' => 620,
            '\u{1100}'.. => 1000,
            _ => 700,
        })
        .sum();
    f64::from(thousandths) / 1000.0 * size * CAUTION
}

/// Where the words' reference point is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    /// The part of the words before their reference point.
    pub(super) fn part(self) -> f64 {
        f64::from(self as u8) / 2.0
    }
}

/// Words in their place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Words {
    pub text: String,
    /// The reference point: horizontally by the anchor, vertically the middle of the digits.
    pub at: Point,
    pub anchor: Anchor,
    pub size: f64,
    pub color: &'static str,
    pub bold: bool,
    /// Reads from bottom to top.
    pub upright: bool,
    /// White around the letters.
    pub halo: bool,
}

impl Words {
    pub(super) fn new(text: impl Into<String>, at: Point, anchor: Anchor, size: f64) -> Self {
        let (text, color) = (legal(&text.into()), "#333333");
        Self { text, at, anchor, size, color, bold: false, upright: false, halo: false }
    }

    /// Width and height, pixels.
    pub(super) fn size(&self) -> Point {
        let room = self.bounds();
        [room.width(), room.height()]
    }

    /// The room that the words take.
    pub(super) fn bounds(&self) -> Rect {
        let width = width(&self.text, self.size) * if self.bold { BOLD } else { 1.0 };
        let height = self.size * 1.05;
        let start = -self.anchor.part() * width;
        let [x, y] = self.at;
        if self.upright {
            return Rect::new(x - height / 2.0, y - start - width, x + height / 2.0, y - start);
        }
        Rect::new(x + start, y - height / 2.0, x + start + width, y + height / 2.0)
    }

    /// The attributes that words of one look share; a halo is the same words below, broad and white.
    fn look(&self, halo: bool) -> String {
        let mut look = if halo {
            "fill=\"#FFFFFF\" stroke=\"#FFFFFF\" stroke-width=\"30\"".to_owned()
        } else {
            format!("fill=\"{}\"", self.color)
        };
        if self.size != SMALL {
            look += &format!(" font-size=\"{}\"", tenths(self.size));
        }
        if self.bold {
            look += " font-weight=\"bold\"";
        }
        look += match self.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        look
    }

    fn element(&self) -> String {
        // From the middle of the digits to the baseline.
        let drop = 0.35 * self.size;
        let text = escape(&self.text);
        if self.upright {
            let [x, y] = [self.at[0] + drop, self.at[1]].map(tenths);
            return format!("<text transform=\"translate({x} {y})rotate(-90)\">{text}</text>\n");
        }
        let [x, y] = [self.at[0], self.at[1] + drop].map(tenths);
        format!("<text x=\"{x}\" y=\"{y}\">{text}</text>\n")
    }
}

/// Writes words, those of one look together, halos below all of them.
pub(super) fn write(svg: &mut String, words: &[Words]) {
    for halo in [true, false] {
        let mut groups: BTreeMap<String, String> = BTreeMap::new();
        for words in words.iter().filter(|words| words.halo || !halo) {
            *groups.entry(words.look(halo)).or_default() += &words.element();
        }
        for (look, elements) in groups {
            *svg += &format!("<g {look}>\n{elements}</g>\n");
        }
    }
}

/// A length as it is written: tenths of a pixel, whole.
pub(super) fn tenths(pixels: f64) -> i32 {
    (pixels * 10.0).round() as i32
}

/// Whether a character acts instead of being seen: on a terminal, on a parser, on the direction of a line; or is not seen at
/// all, so that two texts which differ look alike.
pub fn is_control(letter: char) -> bool {
    let is_format = matches!(letter,
        '\u{ad}' | '\u{600}'..='\u{605}' | '\u{61c}' | '\u{6dd}' | '\u{70f}' | '\u{890}'..='\u{891}'
        | '\u{8e2}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{110bd}' | '\u{110cd}'
        | '\u{13430}'..='\u{1343f}' | '\u{1bca0}'..='\u{1bca3}' | '\u{1d173}'..='\u{1d17a}'
        | '\u{e0000}'..='\u{e0fff}');
    // Fillers of Hangul, joiners and variations of Mongolian and others are drawn as nothing, too.
    let is_blank = matches!(
        letter,
        '\u{34f}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}' | '\u{180b}'
            ..='\u{180f}' | '\u{2028}' | '\u{2029}' | '\u{2800}' | '\u{3164}' | '\u{ffa0}'
    );
    letter.is_control() || is_format || is_blank
}

/// Text with nothing in it that XML forbids or that acts instead of being seen; such characters become U+FFFD.
pub(super) fn legal(text: &str) -> String {
    let replaced = |c: char| match c {
        '\n' | '\t' => ' ',
        c if is_control(c) || matches!(c, '\u{fffe}' | '\u{ffff}') => '\u{fffd}',
        c => c,
    };
    text.chars().map(replaced).collect()
}

/// Text as XML has it.
pub fn escape(text: &str) -> String {
    legal(text)
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// Breaks words at spaces so that no line is wider than `limit` where that is possible; lines are
/// about equally long, none for no words.
pub(super) fn wrap(text: &str, size: f64, limit: f64) -> Vec<String> {
    if text.is_empty() {
        return Vec::new();
    }
    let total = width(text, size);
    if total <= limit || limit <= 0.0 {
        return vec![text.to_owned()];
    }
    let share = total / (total / limit).ceil();
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("starts with one line");
        let joined = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        let full = width(line, size) >= 0.8 * share || width(&joined, size) > limit;
        if line.is_empty() || !full {
            *line = joined;
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}
