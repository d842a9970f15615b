//! Names beside the data, so that nothing covers anything.

use super::candidates::{Candidate, Target, candidates};
use super::data::Panel;
use super::geometry::Rect;
use super::layers::Layer;
use super::layout::{Frame, label_of};
use super::raster::{Raster, bit, words};
use super::shapes::Shape;
use super::text::{Anchor, LARGE, SMALL, Words};

/// White around every label, pixels.
const AIR: f64 = 2.0;
/// Other data this near to a label make it ambiguous, pixels.
const AMBIGUOUS: f64 = 10.0;
/// Within this distance of a line's label, other lines must be less than half of its own, pixels.
const CLOSEST: f64 = 7.0;
/// From labels to the plot's edge, pixels.
const INSET: f64 = 3.0;
/// The radius of the mark for the case at hand, pixels.
pub(super) const STAR: f64 = 9.0;

/// The names of a panel, as far as they found a place.
#[derive(Debug, Default)]
pub(super) struct Labels {
    pub words: Vec<Words>,
    /// Lines from words to what they name.
    pub leaders: Vec<[[f64; 2]; 2]>,
    /// The layers whose names found no place.
    pub homeless: Vec<usize>,
}

struct Request {
    layer: usize,
    words: Words,
    target: Target,
    near: Option<[f64; 2]>,
    /// May go to the legend instead.
    movable: bool,
}

/// Places the names of a panel; layers in its legend have theirs there already.
pub(super) fn place(panel: &Panel, frame: &Frame, shapes: &[Shape]) -> Labels {
    let mut raster = occupied(panel, frame, shapes);
    let mut labels = Labels::default();
    let mut open: Vec<(Request, Vec<Candidate>)> = requests(panel, frame, shapes)
        .into_iter()
        .map(|request| {
            let found = free(&request, panel, frame, &raster);
            (request, found)
        })
        .collect();
    // Words that must be somewhere come first, then those with the fewest places to go.
    open.sort_by_key(|(request, found)| (request.movable, found.len(), request.layer));
    for (request, found) in open {
        let bits = words();
        let clear = |c: &&Candidate| {
            let crossed = c.leader.is_some_and(|[a, b]| {
                (0..=20).any(|k| {
                    let t = f64::from(k) / 20.0;
                    let at = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
                    raster.any(&Rect::around(at, 1.0, 1.0), bits)
                })
            });
            !crossed && !raster.any(&c.room.grown(AIR), bits)
        };
        match found.iter().find(clear).cloned() {
            Some(candidate) => settle(&request, &candidate, &mut raster, &mut labels),
            None if request.movable => labels.homeless.push(request.layer),
            None => {
                if let Some(candidate) = least_bad(&request, frame, &raster) {
                    settle(&request, &candidate, &mut raster, &mut labels);
                }
            }
        }
    }
    labels.homeless.sort_unstable();
    labels
}

fn settle(request: &Request, place: &Candidate, raster: &mut Raster, labels: &mut Labels) {
    raster.take(&place.room.grown(AIR), words());
    if let Some(leader) = place.leader {
        raster.trace(&leader, 1.0, words());
        labels.leaders.push(leader);
    }
    let [x, y] = place.room.center();
    let x = match place.anchor {
        Anchor::Start => place.room.left,
        Anchor::Middle => x,
        Anchor::End => place.room.right,
    };
    labels.words.push(Words { at: [x, y], anchor: place.anchor, ..request.words.clone() });
}

/// The places on free ground, best first.
fn free(request: &Request, panel: &Panel, frame: &Frame, raster: &Raster) -> Vec<Candidate> {
    let inside = frame.plot.grown(-INSET);
    let own = bit(request.layer);
    let lines = lines_of(panel);
    let clear = |c: &Candidate| {
        let near = c.room.grown(CLOSEST);
        let line = matches!(request.target, Target::Lines(_));
        !line || 2 * raster.count(&near, lines & !own) <= raster.count(&near, own)
    };
    let mut found: Vec<Candidate> = all_candidates(request)
        .into_iter()
        .filter(|c| inside.contains(&c.room) && !raster.any(&c.room.grown(AIR), u64::MAX))
        .filter(clear)
        .map(|c| {
            let near = c.room.grown(AMBIGUOUS);
            let (others, own) = (raster.count(&near, !own), raster.count(&near, own));
            let penalty = c.penalty + 0.25 * others as f64 - 0.02 * own.min(50) as f64;
            Candidate { penalty, ..c }
        })
        .collect();
    found.sort_by(|a, b| a.penalty.total_cmp(&b.penalty));
    found
}

/// The bits of all lines.
fn lines_of(panel: &Panel) -> u64 {
    let line = |l: &Layer| matches!(l, Layer::Curve { .. } | Layer::Rule { .. });
    let layers = panel.layers.iter().enumerate().filter(|(_, layer)| line(layer));
    layers.fold(0, |bits, (index, _)| bits | bit(index))
}

fn all_candidates(request: &Request) -> Vec<Candidate> {
    let room = request.words.bounds();
    candidates(&request.target, [room.width(), room.height()], request.near)
}

/// For words that must be somewhere: the place that covers least, other words least of all.
fn least_bad(request: &Request, frame: &Frame, raster: &Raster) -> Option<Candidate> {
    let cover = |c: &Candidate| {
        let outside = if frame.plot.contains(&c.room) { 0 } else { 1_000_000 };
        let room = c.room.grown(AIR);
        outside + 1000 * raster.count(&room, words()) + raster.count(&room, u64::MAX)
    };
    all_candidates(request).into_iter().min_by_key(cover)
}

/// What the data take.
fn occupied(panel: &Panel, frame: &Frame, shapes: &[Shape]) -> Raster {
    let mut raster = Raster::new(frame.plot);
    for (index, (layer, shape)) in panel.layers.iter().zip(shapes).enumerate() {
        match (layer, shape) {
            (Layer::Curve { style, .. } | Layer::Rule { style, .. }, Shape::Lines(lines)) => {
                for line in lines {
                    raster.trace(line, style.width, bit(index));
                }
            }
            (Layer::Points { marker, .. }, Shape::Dots(dots)) => {
                for dot in dots {
                    let side = marker.diameter + 1.0;
                    raster.take(&Rect::around(dot.at, side, side), bit(index));
                }
            }
            (Layer::ThisCase { .. }, Shape::Place(at)) => {
                raster.take(&Rect::around(*at, 2.0 * STAR, 2.0 * STAR), bit(index));
            }
            _ => {}
        }
    }
    raster
}

fn requests(panel: &Panel, frame: &Frame, shapes: &[Shape]) -> Vec<Request> {
    let mut all = Vec::new();
    for (layer, (data, shape)) in panel.layers.iter().zip(shapes).enumerate() {
        let words = |text: &str, color| Words {
            color,
            halo: true,
            ..Words::new(text, [0.0; 2], Anchor::Middle, SMALL)
        };
        let fixed = |words, target| Request { layer, words, target, near: None, movable: false };
        match (data, shape) {
            (Layer::Points { points, color, marker, .. }, Shape::Dots(dots)) => {
                for dot in dots {
                    if let Some(label) = &points[dot.index].label {
                        let target = Target::Point(dot.at, marker.diameter / 2.0);
                        all.push(fixed(words(label, color.text_hex()), target));
                    }
                }
            }
            (Layer::Note { text, color, .. }, Shape::Place(at)) => {
                let words = Words { size: LARGE, ..words(text, color.text_hex()) };
                all.push(fixed(words, Target::Place(*at)));
            }
            (Layer::ThisCase { .. }, Shape::Place(at)) => {
                let words = Words { bold: true, ..words("this case", "#000000") };
                all.push(fixed(words, Target::Point(*at, STAR)));
            }
            _ => {}
        }
        let named = frame.legend.iter().any(|(k, _)| *k == layer);
        let Some(label) = label_of(data).filter(|_| !named) else { continue };
        let Some(target) = target(data, shape) else { continue };
        let near =
            label.near.map(|at| frame.map(at)).filter(|p| p[0].is_finite() && p[1].is_finite());
        let words = words(&label.text, color_of(data));
        all.push(Request { layer, words, target, near, movable: true });
    }
    all
}

/// What a layer's name can be put beside; nothing if nothing of it is visible.
fn target(layer: &Layer, shape: &Shape) -> Option<Target> {
    match (layer, shape) {
        (_, Shape::Lines(lines)) if !lines.is_empty() => Some(Target::Lines(lines.clone())),
        (Layer::Points { marker, .. }, Shape::Dots(dots)) if !dots.is_empty() => {
            let places = dots.iter().map(|dot| dot.at).collect();
            Some(Target::Dots(places, marker.diameter / 2.0))
        }
        (_, Shape::Area(area)) if !area.is_empty() => Some(Target::Area(area.clone())),
        _ => None,
    }
}

/// The colour of a layer's words.
pub(super) const fn color_of(layer: &Layer) -> &'static str {
    match layer {
        Layer::Curve { style, .. } | Layer::Rule { style, .. } => style.color.text_hex(),
        Layer::Points { color, .. } | Layer::Note { color, .. } => color.text_hex(),
        Layer::Band { fill, .. } => fill.color.text_hex(),
        Layer::ThisCase { .. } | Layer::Image(_) => "#000000",
    }
}
