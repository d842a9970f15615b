#!/usr/bin/env python3
"""Compares the public interface of the physics with docs/public-api.txt.

Run it after `cargo doc --no-deps`; with `--update` it writes the list. Each room is read from the pages of the crate that it
stands in: `vinesink-core` has it under the same name.
"""

import argparse
import difflib
import os
import re
import sys
from html.parser import HTMLParser
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LIST = ROOT / "docs" / "public-api.txt"
WHOLE = "vinesink_core"
PARTS = ["vinesink_base", "vinesink_orbits", "vinesink_simulation"]
# Ids on the page of an item; a field of a variant is `variant.NAME.field.NAME`.
MEMBER = re.compile(
    r"(method|tymethod|variant|structfield|associatedconstant|associatedtype)\.\w+(\.field\.\w+)?"
)
# Sections that list what every type has, or what other crates' traits add.
FOREIGN = {"trait-implementations-list", "synthetic-implementations-list", "blanket-implementations-list"}
# Kinds of items whose declaration has no members of its own.
TYPED = {"fn", "constant", "static", "type"}
VOID = {"area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "wbr"}


class Links(HTMLParser):
    """The items of all.html."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attributes):
        href = dict(attributes).get("href") or ""
        if tag == "a" and re.fullmatch(r"(?:[\w]+/)*\w+\.\w+\.html", href):
            self.found.append(href)


class Members(HTMLParser):
    """Methods, fields, variants and constants on the page of an item, but for those of trait implementations:
    each by its id with its declaration; the item's own declaration under "".
    """

    def __init__(self):
        super().__init__()
        self.open = []
        self.found = {}
        self.non_exhaustive = False
        # The id whose declaration comes next, and how many elements are open where it stands.
        self.declared = ""
        self.depth = None

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        name = attributes.get("id") or ""
        if not any(one in FOREIGN for one in self.open) and MEMBER.fullmatch(name):
            self.found[name] = ""
            self.declared = name
        elif self.depth is None and self.declared is not None and (
            tag == "code" or "code-header" in (attributes.get("class") or "").split()
        ):
            self.depth = len(self.open)
        if name.endswith("non-exhaustive") or "non-exhaustive" in (attributes.get("class") or "").split():
            self.non_exhaustive = True
        if tag not in VOID:
            self.open.append(name)

    def handle_endtag(self, tag):
        if tag not in VOID and self.open:
            self.open.pop()
            if len(self.open) == self.depth:
                self.declared = self.depth = None

    def handle_data(self, text):
        if self.depth is not None:
            self.found[self.declared] = self.found.get(self.declared, "") + text


def parsed(parser, path):
    parser.feed(path.read_text(encoding="utf-8"))
    parser.close()
    return parser


def item_lines(folder, href):
    """`struct system::System`, then its members; functions, constants and fields with their types."""
    *modules, file = href.split("/")
    kind, name, _ = file.split(".")
    path = "::".join([*modules, name])
    page = parsed(Members(), folder / href)
    own = page.found.pop("", "")
    yield with_type(f"{kind} {path}", own if kind in TYPED else "") + (" non_exhaustive" if page.non_exhaustive else "")
    for member, declaration in page.found.items():
        member_kind, rest = member.split(".", 1)
        member_kind = "method" if member_kind == "tymethod" else member_kind
        yield with_type(f"{member_kind} {path}::{rest.replace('.field.', '::')}", declaration)


def with_type(line, declaration):
    """The line with what follows the name in a declaration: arguments and results, or a type."""
    name = re.escape(line.rsplit("::", 1)[-1].split(" ")[-1])
    words = " ".join(declaration.split()).replace("( ", "(").replace(", )", ")")
    rest = re.search(rf"\b{name}\b(.*)", words)
    return line + (rest.group(1).rstrip(",; ") if rest else "")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--update", action="store_true", help="write the list")
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    arguments.add_argument("--doc", type=Path, default=target / "doc", help="folder of cargo doc")
    given = arguments.parse_args()
    rooms, found = set(), set()
    for crate in [*PARTS, WHOLE]:
        folder = given.doc / crate
        if not (folder / "all.html").is_file():
            sys.exit(f"{folder / 'all.html'} is missing: run `cargo doc --no-deps`")
        links = [href for href in parsed(Links(), folder / "all.html").found if href.split("/")[0] not in rooms]
        rooms |= {href.split("/")[0] for href in links}
        found |= {line for href in links for line in item_lines(folder, href)}
    missing = sorted(room for room in rooms if not (given.doc / WHOLE / room / "index.html").is_file())
    if missing:
        sys.exit(f"{WHOLE} lacks {', '.join(missing)}")
    lines = sorted(found)
    now = "".join(f"{line}\n" for line in lines)
    if given.update:
        LIST.write_text(now, encoding="utf-8")
        print(f"{LIST.relative_to(ROOT)}: {len(lines)} items")
        return
    before = LIST.read_text(encoding="utf-8") if LIST.is_file() else ""
    if before == now:
        print(f"{len(lines)} public items, as in {LIST.relative_to(ROOT)}")
        return
    changes = difflib.unified_diff(
        before.splitlines(), now.splitlines(), "docs/public-api.txt", "this version", lineterm="", n=0
    )
    print("\n".join(changes))
    sys.exit("the public interface changed; if that is meant, run `python3 docs/public-api.py --update`")


if __name__ == "__main__":
    main()
