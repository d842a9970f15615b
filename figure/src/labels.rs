//! Names beside the data, so that nothing covers anything.

use super::candidates::{Candidate, of_layer, of_point};
use super::data::Panel;
use super::geometry::{Point, Rect, distance, is_finite};
use super::layers::{Hatch, Layer};
use super::layout::Frame;
use super::palette::Marker;
use super::raster::{Raster, WORDS, bit};
use super::shapes::ShapeOfLayer;
use super::text::{Anchor, LARGE, SMALL, Words};

/// White around every label, pixels.
const AIR: f64 = 2.0;
/// Between the words of two labels on one height, beside it, pixels.
const SPACE: f64 = 8.0;
/// Other data this near to a label make it ambiguous, pixels.
const AMBIGUOUS: f64 = 10.0;
/// Within this distance of a line's label, other lines must be less than half of its own, pixels.
const CLOSEST: f64 = 7.0;
/// From labels to the plot's edge, pixels.
const INSET: f64 = 3.0;

/// The names of a panel, as far as they found a place.
#[derive(Debug, Default)]
pub(super) struct Labels {
    pub words: Vec<Words>,
    /// Lines from words to what they name.
    pub leaders: Vec<[Point; 2]>,
    /// The layers whose names found no place.
    pub homeless: Vec<usize>,
}

/// Words that want a place.
struct LabelRequest {
    layer: usize,
    words: Words,
    places: Vec<Candidate>,
    /// Names a line, and must be nearer to it than to another.
    beside_line: bool,
    /// May go to the legend instead.
    movable: bool,
}

/// Places the names of a panel; layers in its legend have theirs there already.
pub(super) fn place(panel: &Panel, frame: &Frame, shapes: &[ShapeOfLayer]) -> Labels {
    let mut raster = occupied(panel, frame, shapes);
    let mut labels = Labels::default();
    let lines =
        shapes.iter().enumerate().filter(|(_, shape)| matches!(shape, ShapeOfLayer::Lines(_)));
    let lines = lines.fold(0, |bits, (index, _)| bits | bit(index));
    let with_free_places = |request: LabelRequest| {
        let found = free(&request, frame, lines, &raster);
        (request, found)
    };
    let mut open: Vec<(LabelRequest, Vec<Candidate>)> =
        requests(panel, frame, shapes).into_iter().map(with_free_places).collect();
    // Words that must be somewhere come first, then those with the fewest places to go.
    open.sort_by_key(|(request, found)| (request.movable, found.len(), request.layer));
    for (request, found) in open {
        let clear = |place: &&Candidate| {
            // Words on a line would read as one phrase.
            let room = place.room.grown(AIR);
            let beside = Rect { left: room.left - SPACE, right: room.right + SPACE, ..room };
            !raster.any(&beside, WORDS)
                && !place.leader.is_some_and(|leader| raster.words_on(&leader))
        };
        let free = found.iter().find(clear);
        let Some(place) = free.or_else(|| least_bad(&request, frame, &raster)) else {
            labels.homeless.push(request.layer);
            continue;
        };
        let halo = request.words.halo || free.is_none();
        let words = Words { halo, ..request.words.clone() };
        settle(words, place, &mut raster, &mut labels);
    }
    labels.homeless.sort_unstable();
    labels
}

fn settle(words: Words, place: &Candidate, raster: &mut Raster, labels: &mut Labels) {
    raster.take(&place.room.grown(AIR), WORDS);
    if let Some(leader) = place.leader {
        raster.trace(&leader, 1.0, WORDS);
        labels.leaders.push(leader);
    }
    let x = place.room.left + place.anchor.part() * place.room.width();
    labels.words.push(Words { at: [x, place.room.center()[1]], anchor: place.anchor, ..words });
}

/// The places on free ground, best first.
fn free(request: &LabelRequest, frame: &Frame, lines: u64, raster: &Raster) -> Vec<Candidate> {
    let inside = frame.plot.grown(-INSET);
    let own = bit(request.layer);
    let beside_its_line = |c: &Candidate| {
        let [others, own] = raster.count(&c.room.grown(CLOSEST), [lines & !own, own]);
        2 * others <= own
    };
    let clear = |c: &&Candidate| {
        inside.contains(&c.room)
            && !raster.any(&c.room.grown(AIR), u64::MAX)
            && (!request.beside_line || beside_its_line(c))
    };
    let judged = |c: &Candidate| {
        let [others, own] = raster.count(&c.room.grown(AMBIGUOUS), [!own, own]);
        let penalty = c.penalty + 0.25 * others as f64 - 0.02 * own.min(50) as f64;
        Candidate { penalty, ..*c }
    };
    let mut found: Vec<Candidate> = request.places.iter().filter(clear).map(judged).collect();
    found.sort_by(|a, b| a.penalty.total_cmp(&b.penalty));
    found
}

/// For words that must be somewhere: the place that covers least, other words least of all.
fn least_bad<'a>(
    request: &'a LabelRequest,
    frame: &Frame,
    raster: &Raster,
) -> Option<&'a Candidate> {
    let cover = |c: &&Candidate| {
        let outside = if frame.plot.contains(&c.room) { 0 } else { 1_000_000 };
        let [words, all] = raster.count(&c.room.grown(AIR), [WORDS, u64::MAX]);
        outside + 1000 * words + all
    };
    request.places.iter().filter(|_| !request.movable).min_by_key(cover)
}

/// What the data take.
fn occupied(panel: &Panel, frame: &Frame, shapes: &[ShapeOfLayer]) -> Raster {
    let mut raster = Raster::new(frame.plot);
    for (index, (layer, shape)) in panel.layers.iter().zip(shapes).enumerate() {
        match (layer, shape) {
            (
                Layer::Curve { style, .. } | Layer::Rule { style, .. },
                ShapeOfLayer::Lines(lines),
            ) => {
                lines.iter().for_each(|line| raster.trace(line, style.width, bit(index)));
            }
            (Layer::Points { marker, .. }, ShapeOfLayer::Dots(dots)) if *marker != Marker::NONE => {
                let side = marker.diameter + 1.0;
                for dot in dots {
                    raster.take(&Rect::around(dot.at, side, side), bit(index));
                }
            }
            _ => {}
        }
    }
    raster
}

/// All words of a panel with the places that they could take.
fn requests(panel: &Panel, frame: &Frame, shapes: &[ShapeOfLayer]) -> Vec<LabelRequest> {
    let mut all = Vec::new();
    // Words keep off all data but areas and images: the lines in these run through them, and their colours may be dark.
    let crossed = |layer: &Layer| match layer {
        Layer::Band { fill, .. } => fill.hatch != Hatch::None,
        other => matches!(other, Layer::Image(_)),
    };
    let halo = panel.layers.iter().any(crossed);
    for (layer, (data, shape)) in panel.layers.iter().zip(shapes).enumerate() {
        let color = data.text_color();
        let words =
            |text: &str| Words { color, halo, ..Words::new(text, [0.0; 2], Anchor::Middle, SMALL) };
        if let (Layer::Points { points, marker, .. }, ShapeOfLayer::Dots(dots)) = (data, shape) {
            let size = if *marker == Marker::NONE { LARGE } else { SMALL };
            for dot in dots {
                let Some(label) = &points[dot.index].label else { continue };
                let words = Words { size, bold: *marker == Marker::THIS_CASE, ..words(label) };
                let places = of_point(dot.at, marker.diameter / 2.0, words.size());
                all.push(LabelRequest { layer, words, places, beside_line: false, movable: false });
            }
        }
        let named = frame.legend.iter().any(|(k, _)| *k == layer);
        let Some(label) = data.label().filter(|_| !named) else { continue };
        let words = words(&label.text);
        let mut places = of_layer(data, shape, words.size());
        if let Some(near) = label.near.map(|at| frame.map(at)).filter(is_finite) {
            for place in &mut places {
                place.penalty += 0.3 * distance(place.room.center(), near);
            }
        }
        let beside_line = matches!(shape, ShapeOfLayer::Lines(_));
        if !places.is_empty() {
            all.push(LabelRequest { layer, words, places, beside_line, movable: true });
        }
    }
    all
}
