//! Where words have room: axes turned into pixels, about as large as they will be drawn.

/// Width and height of a plot in a figure of the usual size, pixels.
const PLOT: [f64; 2] = [640.0, 375.0];
/// Words stay that far away from marks, pixels.
const AWAY: f64 = 55.0;

/// The axes of a plot.
#[derive(Debug, Clone, Copy)]
pub(super) struct Canvas {
    pub x: (f64, f64),
    pub y: (f64, f64),
    pub log_y: bool,
}

/// A place for words, and how much height there is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Room {
    /// In data coordinates.
    pub at: [f64; 2],
    /// Pixels.
    pub height: f64,
}

impl Canvas {
    fn height(&self, y: f64) -> f64 {
        let part = if self.log_y {
            libm::log(y / self.y.0) / libm::log(self.y.1 / self.y.0)
        } else {
            (y - self.y.0) / (self.y.1 - self.y.0)
        };
        PLOT[1] * part.clamp(0.0, 1.0)
    }

    fn value(&self, height: f64) -> f64 {
        let part = height / PLOT[1];
        if self.log_y {
            self.y.0 * libm::pow(self.y.1 / self.y.0, part)
        } else {
            self.y.0 + part * (self.y.1 - self.y.0)
        }
    }

    /// The roomiest place for words of a given width between two lines, away from marks.
    pub(super) fn roomiest(
        &self,
        lower: &dyn Fn(f64) -> f64,
        upper: &dyn Fn(f64) -> f64,
        width: f64,
        marks: &[[f64; 2]],
    ) -> Option<Room> {
        const COLUMNS: i32 = 80;
        let column = |k: i32| f64::from(k) / f64::from(COLUMNS);
        let x = |part: f64| self.x.0 + part * (self.x.1 - self.x.0);
        let reach = (width / 2.0 / PLOT[0] * f64::from(COLUMNS)).ceil() as i32;
        let band = |k: i32| {
            let at = x(column(k));
            [self.height(lower(at)), self.height(upper(at))]
        };
        let bands: Vec<[f64; 2]> = (0..=COLUMNS).map(band).collect();
        let mut best: Option<(f64, Room)> = None;
        for k in reach + 1..COLUMNS - reach {
            let part = &bands[(k - reach) as usize..=(k + reach) as usize];
            if part.iter().flatten().any(|height| height.is_nan()) {
                continue;
            }
            let low = part.iter().map(|band| band[0]).fold(0.0, f64::max);
            let high = part.iter().map(|band| band[1]).fold(PLOT[1], f64::min);
            let (height, middle) = (high - low, f64::midpoint(low, high));
            let near = marks.iter().map(|mark| {
                let dx = (x(column(k)) - mark[0]) / (self.x.1 - self.x.0) * PLOT[0];
                let free =
                    libm::hypot((dx.abs() - width / 2.0).max(0.0), middle - self.height(mark[1]));
                (AWAY - free).max(0.0)
            });
            // More height than words need is worth little; the middle of the figure is worth something.
            let off_center = 20.0 * (column(k) - 0.5).abs();
            let worth = height.min(90.0) - 2.0 * near.sum::<f64>() - off_center;
            if height > 0.0 && best.is_none_or(|(most, _)| worth > most) {
                let at = [x(column(k)), self.value(middle)];
                best = Some((worth, Room { at, height }));
            }
        }
        best.map(|(_, room)| room)
    }
}

/// The height of a line, whose points ascend, between its points; NaN beside it.
pub(super) fn interpolated(line: &[[f64; 2]], x: f64) -> f64 {
    let after = line.partition_point(|point| point[0] < x);
    let (Some(right), Some(left)) = (line.get(after), line.get(after.wrapping_sub(1))) else {
        return f64::NAN;
    };
    left[1] + (right[1] - left[1]) * (x - left[0]) / (right[0] - left[0])
}
