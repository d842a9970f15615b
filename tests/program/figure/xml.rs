//! Just enough of XML and SVG paths to look into the figures.

/// Panics unless tags nest, attributes are quoted and text has no stray markup.
pub fn check(xml: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = xml;
    let mut roots = 0;
    while let Some(start) = rest.find('<') {
        text(&rest[..start]);
        let end = rest.find('>').expect("a tag ends");
        let tag = &rest[start + 1..end];
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "wrong closing tag");
        } else {
            roots += usize::from(open.is_empty());
            let name = tag.split([' ', '/']).next().unwrap();
            assert!(name.chars().all(|c| c.is_ascii_alphabetic()), "<{tag}>");
            attributes(tag.trim_end_matches('/')[name.len()..].trim_start());
            if !tag.ends_with('/') {
                open.push(name);
            }
        }
        rest = &rest[end + 1..];
    }
    assert!(open.is_empty() && rest.trim().is_empty() && roots == 1, "open: {open:?}");
}

fn attributes(mut list: &str) {
    let mut seen = Vec::new();
    while !list.is_empty() {
        let (name, rest) = list.split_once("=\"").expect("name=\"");
        let (value, rest) = rest.split_once('"').expect("closing quote");
        assert!(!seen.contains(&name) && !name.contains(' '), "attribute {name}");
        seen.push(name);
        text(value);
        list = rest.trim_start();
    }
}

fn text(text: &str) {
    assert!(!text.contains(['<', '>']), "{text:?}");
    assert!(text.chars().all(|c| c == '\n' || !c.is_control()), "{text:?}");
    for (at, _) in text.match_indices('&') {
        let known = ["&lt;", "&gt;", "&amp;", "&quot;", "&apos;"];
        assert!(known.iter().any(|k| text[at..].starts_with(k)), "{text:?}");
    }
}

/// The frame of the first plot: left, top, right, bottom, tenths of a pixel.
pub fn frame(svg: &str) -> [f64; 4] {
    let polyline =
        svg.split("<polyline").find(|p| p.contains("#777777") && p.matches(',').count() > 4);
    let points =
        polyline.expect("a frame").split("points=\"").nth(1).unwrap().split('"').next().unwrap();
    let corners: Vec<Vec<f64>> = points
        .split_whitespace()
        .map(|p| p.split(',').map(|v| v.parse().unwrap()).collect())
        .collect();
    [corners[0][0], corners[0][1], corners[2][0], corners[2][1]]
}

/// The lines of curves and rules, in tenths of a pixel.
pub fn lines(svg: &str) -> Vec<Vec<[f64; 2]>> {
    let tags = svg.split("<path d=\"").skip(1).map(|rest| rest.split('>').next().unwrap());
    let of_lines = |tag: &&str| {
        tag.contains(" stroke=") && !tag.contains("fill=") && !tag.contains("stroke-opacity")
    };
    tags.filter(of_lines).flat_map(|tag| path(tag.split('"').next().unwrap())).collect()
}

/// All vertices of all paths.
pub fn paths(svg: &str) -> Vec<Vec<[f64; 2]>> {
    svg.split("<path d=\"").skip(1).flat_map(|tag| path(tag.split('"').next().unwrap())).collect()
}

fn path(d: &str) -> Vec<Vec<[f64; 2]>> {
    let mut all: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut at = [0.0, 0.0];
    let commands: Vec<usize> =
        d.char_indices().filter(|(_, c)| c.is_ascii_alphabetic()).map(|(i, _)| i).collect();
    for (k, &start) in commands.iter().enumerate() {
        let end = commands.get(k + 1).copied().unwrap_or(d.len());
        let numbers = numbers(&d[start + 1..end]);
        match &d[start..=start] {
            "M" | "m" => {
                let base = if &d[start..=start] == "m" { at } else { [0.0, 0.0] };
                at = [base[0] + numbers[0], base[1] + numbers[1]];
                all.push(vec![at]);
            }
            "L" | "l" => {
                for pair in numbers.chunks(2) {
                    let base = if &d[start..=start] == "l" { at } else { [0.0, 0.0] };
                    at = [base[0] + pair[0], base[1] + pair[1]];
                    all.last_mut().unwrap().push(at);
                }
            }
            "h" => at[0] += numbers[0],
            "v" => at[1] += numbers[0],
            "a" => at = [at[0] + numbers[5], at[1] + numbers[6]],
            "z" => at = all.last().unwrap()[0],
            other => panic!("command {other}"),
        }
        all.last_mut().unwrap().push(at);
    }
    all
}

fn numbers(text: &str) -> Vec<f64> {
    let spaced = text.replace('-', " -");
    spaced.split_whitespace().map(|n| n.parse().unwrap_or_else(|_| panic!("{n}"))).collect()
}

/// The distance of a point from a segment.
pub fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let square = d[0] * d[0] + d[1] * d[1];
    let along = (p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1];
    let t = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(p[0] - a[0] - t * d[0], p[1] - a[1] - t * d[1])
}
