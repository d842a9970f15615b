//! Rectangles in pixels, and cutting lines and areas at them.

/// A rectangle in pixels; `top` is above `bottom`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Smallest abscissa.
    pub left: f64,
    /// Smallest ordinate.
    pub top: f64,
    /// Largest abscissa.
    pub right: f64,
    /// Largest ordinate.
    pub bottom: f64,
}

impl Rect {
    pub(super) const fn new(left: f64, top: f64, right: f64, bottom: f64) -> Self {
        Self { left, top, right, bottom }
    }

    pub(super) fn around([x, y]: [f64; 2], width: f64, height: f64) -> Self {
        Self::new(x - width / 2.0, y - height / 2.0, x + width / 2.0, y + height / 2.0)
    }

    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub(super) fn center(&self) -> [f64; 2] {
        [f64::midpoint(self.left, self.right), f64::midpoint(self.top, self.bottom)]
    }

    pub(super) fn grown(&self, by: f64) -> Self {
        Self::new(self.left - by, self.top - by, self.right + by, self.bottom + by)
    }

    pub(super) fn has([x, y]: [f64; 2], rect: &Self) -> bool {
        x >= rect.left && x <= rect.right && y >= rect.top && y <= rect.bottom
    }

    /// Whether the other rectangle lies inside this one.
    #[must_use]
    pub fn contains(&self, other: &Self) -> bool {
        other.left >= self.left
            && other.right <= self.right
            && other.top >= self.top
            && other.bottom <= self.bottom
    }

    /// Whether the two have points in common; touching edges do not count.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }
}

/// The part of a segment inside a rectangle (Liang and Barsky).
pub(super) fn clip_segment(rect: &Rect, a: [f64; 2], b: [f64; 2]) -> Option<([f64; 2], [f64; 2])> {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let delta = [b[0] - a[0], b[1] - a[1]];
    let bounds = [(rect.left, rect.right), (rect.top, rect.bottom)];
    for axis in 0..2 {
        let (low, high) = bounds[axis];
        if delta[axis] == 0.0 {
            if a[axis] < low || a[axis] > high {
                return None;
            }
            continue;
        }
        let to_low = (low - a[axis]) / delta[axis];
        let to_high = (high - a[axis]) / delta[axis];
        enter = enter.max(to_low.min(to_high));
        leave = leave.min(to_low.max(to_high));
    }
    let at = |t: f64| {
        // The ends stay as they are, bit for bit, so that neighbouring pieces join.
        if t == 0.0 {
            a
        } else if t == 1.0 {
            b
        } else {
            [
                (a[0] + t * delta[0]).clamp(rect.left, rect.right),
                (a[1] + t * delta[1]).clamp(rect.top, rect.bottom),
            ]
        }
    };
    (enter <= leave).then(|| (at(enter), at(leave)))
}

/// The parts of a polyline inside a rectangle; points that are not finite interrupt it.
pub(super) fn clip_polyline(rect: &Rect, points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    let finite = |p: &[f64; 2]| p[0].is_finite() && p[1].is_finite();
    for pair in points.windows(2) {
        if !(finite(&pair[0]) && finite(&pair[1])) {
            continue;
        }
        let Some((a, b)) = clip_segment(rect, pair[0], pair[1]) else { continue };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&a) => piece.push(b),
            _ => pieces.push(vec![a, b]),
        }
    }
    pieces
}

/// The part of a polygon inside a rectangle (Sutherland and Hodgman).
pub(super) fn clip_polygon(rect: &Rect, corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> =
        corners.iter().filter(|p| p[0].is_finite() && p[1].is_finite()).copied().collect();
    let sides =
        [(0, rect.left, 1.0), (0, rect.right, -1.0), (1, rect.top, 1.0), (1, rect.bottom, -1.0)];
    for (axis, bound, sign) in sides {
        let inside = |p: &[f64; 2]| sign * (p[axis] - bound) >= 0.0;
        let mut next = Vec::with_capacity(kept.len() + 4);
        for (i, &b) in kept.iter().enumerate() {
            let a = kept[(i + kept.len() - 1) % kept.len()];
            if inside(&a) != inside(&b) {
                let t = (bound - a[axis]) / (b[axis] - a[axis]);
                let mut cut = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
                cut[axis] = bound;
                next.push(cut);
            }
            if inside(&b) {
                next.push(b);
            }
        }
        kept = next;
    }
    if kept.len() < 3 { Vec::new() } else { kept }
}

/// Whether a point lies in a polygon, by the even-odd rule.
pub(super) fn in_polygon(corners: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let mut inside = false;
    for (i, b) in corners.iter().enumerate() {
        let a = corners[(i + corners.len() - 1) % corners.len()];
        if (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
            inside = !inside;
        }
    }
    inside
}

/// The squared distance of a point from a segment (not from the line through it: a curve may turn back).
pub(super) fn square_distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let square = dx * dx + dy * dy;
    let t = if square > 0.0 { ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square } else { 0.0 };
    let t = t.clamp(0.0, 1.0);
    let (ex, ey) = (p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
    ex * ex + ey * ey
}
