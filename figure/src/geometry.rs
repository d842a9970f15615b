//! Points and rectangles in pixels, and cutting lines and areas at them.

/// A point: abscissa and ordinate.
pub(super) type Point = [f64; 2];

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

    pub(super) fn around([x, y]: Point, width: f64, height: f64) -> Self {
        Self::new(x - width / 2.0, y - height / 2.0, x + width / 2.0, y + height / 2.0)
    }

    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub(super) fn center(&self) -> Point {
        [f64::midpoint(self.left, self.right), f64::midpoint(self.top, self.bottom)]
    }

    pub(super) fn grown(&self, by: f64) -> Self {
        Self::new(self.left - by, self.top - by, self.right + by, self.bottom + by)
    }

    pub(super) fn has(&self, [x, y]: Point) -> bool {
        self.contains(&Self::new(x, y, x, y))
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

/// The point at a part of the way from one to another.
pub(super) fn lerp(a: Point, b: Point, t: f64) -> Point {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

pub(super) fn is_finite(p: &Point) -> bool {
    p[0].is_finite() && p[1].is_finite()
}

/// The part of a segment inside a rectangle (Liang and Barsky).
fn clip_segment(rect: &Rect, a: Point, b: Point) -> Option<[Point; 2]> {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (axis, low, high) in [(0, rect.left, rect.right), (1, rect.top, rect.bottom)] {
        if a[axis] == b[axis] {
            if a[axis] < low || a[axis] > high {
                return None;
            }
            continue;
        }
        let [to_low, to_high] = [low, high].map(|bound| (bound - a[axis]) / (b[axis] - a[axis]));
        enter = enter.max(to_low.min(to_high));
        leave = leave.min(to_low.max(to_high));
    }
    let cut = |t: f64| {
        let [x, y] = lerp(a, b, t);
        [x.clamp(rect.left, rect.right), y.clamp(rect.top, rect.bottom)]
    };
    // The ends stay as they are, bit for bit, so that neighbouring pieces join.
    let first = if enter == 0.0 { a } else { cut(enter) };
    let last = if leave == 1.0 { b } else { cut(leave) };
    (enter <= leave).then_some([first, last])
}

/// The parts of a polyline inside a rectangle; points that are not finite interrupt it.
pub(super) fn clip_polyline(rect: &Rect, points: &[Point]) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    for pair in points.windows(2).filter(|pair| pair.iter().all(is_finite)) {
        let Some([a, b]) = clip_segment(rect, pair[0], pair[1]) else { continue };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&a) => piece.push(b),
            _ => pieces.push(vec![a, b]),
        }
    }
    pieces
}

/// The part of a polygon inside a rectangle (Sutherland and Hodgman).
pub(super) fn clip_polygon(rect: &Rect, corners: &[Point]) -> Vec<Point> {
    let mut kept: Vec<Point> = corners.iter().filter(|p| is_finite(p)).copied().collect();
    let sides =
        [(0, rect.left, 1.0), (0, rect.right, -1.0), (1, rect.top, 1.0), (1, rect.bottom, -1.0)];
    for (axis, bound, sign) in sides {
        let inside = |p: &Point| sign * (p[axis] - bound) >= 0.0;
        let mut next = Vec::with_capacity(kept.len() + 4);
        for (i, &b) in kept.iter().enumerate() {
            let a = kept[(i + kept.len() - 1) % kept.len()];
            if inside(&a) != inside(&b) {
                let mut cut = lerp(a, b, (bound - a[axis]) / (b[axis] - a[axis]));
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

/// The edges of a polygon.
fn edges(corners: &[Point]) -> impl Iterator<Item = [Point; 2]> {
    let before = corners.last().into_iter().chain(corners);
    before.zip(corners).map(|(a, b)| [*a, *b])
}

/// Whether a point is in a polygon, by the even-odd rule.
pub(super) fn is_inside(corners: &[Point], [x, y]: Point) -> bool {
    let crossed = |[a, b]: &[Point; 2]| {
        (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    edges(corners).filter(crossed).count() % 2 == 1
}

/// How far a point in a polygon is from its edges; less than 0 outside of it.
pub(super) fn depth(corners: &[Point], p: Point) -> f64 {
    let nearest = edges(corners).map(|[a, b]| square_distance(p, a, b));
    let nearest = nearest.fold(f64::INFINITY, f64::min).sqrt();
    if is_inside(corners, p) { nearest } else { -nearest }
}

/// The squared distance of a point from a segment (not from the line through it: a curve may turn back).
pub(super) fn square_distance(p: Point, a: Point, b: Point) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let square = dx * dx + dy * dy;
    let t = if square > 0.0 { ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square } else { 0.0 };
    let [x, y] = lerp(a, b, t.clamp(0.0, 1.0));
    (p[0] - x) * (p[0] - x) + (p[1] - y) * (p[1] - y)
}
