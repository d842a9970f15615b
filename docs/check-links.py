"""Checks every internal link, image and anchor of the built book.

    check-links.py FOLDER

Names each that leads nowhere, and ends with 1 if there is one. Links to other hosts are not followed.
"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# Made of all pages for printing, in which anchors repeat; and pages of the theme.
LEFT_OUT = {"print.html", "404.html", "toc.html"}


class Page(HTMLParser):
    """What a page refers to, and what can be referred to in it."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[tuple[int, str]] = []
        self.anchors: set[str] = set()
        self.without_alt: list[int] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = dict(attributes)
        for name in ("id", "name"):
            if values.get(name):
                self.anchors.add(values[name])
        for name in ("href", "src"):
            if values.get(name):
                self.links.append((self.getpos()[0], values[name]))
        if tag == "img" and not values.get("alt"):
            self.without_alt.append(self.getpos()[0])


def main(folder: Path) -> int:
    pages = {path.resolve(): Page(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.html"))}
    faults, links = [], 0
    for path, page in pages.items():
        if path.name in LEFT_OUT:
            continue
        for line in page.without_alt:
            faults.append(f"{path.relative_to(folder)}:{line}: an image without alternative text")
        for line, link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            links += 1
            target = path if not parts.path else (path.parent / unquote(parts.path)).resolve()
            if target.is_dir():
                target = target / "index.html"
            where = f"{path.relative_to(folder)}:{line}: {link}"
            if not target.is_relative_to(folder):
                faults.append(f"{where} leaves the book")
            elif not target.is_file():
                faults.append(f"{where} names no file")
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                faults.append(f"{where} names no anchor")
    for fault in faults:
        print(fault)
    print(f"{len(pages)} pages, {links} internal links, {len(faults)} faults")
    return 1 if faults or not links else 0


if len(sys.argv) != 2:
    sys.exit("usage: check-links.py FOLDER")
sys.exit(main(Path(sys.argv[1]).resolve()))
