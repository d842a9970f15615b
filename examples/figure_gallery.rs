//! Writes the gallery's figures into the directory given as the only argument.

#[path = "../tests/figure/gallery.rs"]
mod gallery;

fn main() {
    let directory = std::env::args().nth(1).expect("a directory");
    for figure in gallery::all() {
        let start = std::time::Instant::now();
        let svg = vinesink::report::figure::render(&figure).expect("a figure that can be drawn");
        println!("{:12} {:7} bytes {:?}", figure.name, svg.len(), start.elapsed());
        std::fs::write(format!("{directory}/{}.svg", figure.name), svg).expect("a writable file");
    }
}
