"""A preprocessor of mdBook, whose sources read well without it: formulas between dollar signs become MathML, as
`formulas.json` has it, and a picture that leads to the live page becomes the page itself, in a frame.

`cargo test --test book` holds that file against the program's own converter, and writes it with
SNAPSHOTS=overwrite.
"""

import json
import re
import sys
from pathlib import Path

FORMULA = re.compile(r"(`+)(?:.+?)\1|\$\$(?P<block>.+?)\$\$|\$(?P<inline>[^$\n]+?)\$")
# The title of such a link says how high the frame is, and what the page shows.
LIVE = re.compile(r'\[!\[(?P<name>[^]]*)\]\([^)]*\)\]\(live\.md "live (?P<height>\d+)px ?(?P<shown>[^"]*)"\)')
FILE = re.compile(r'\]\(live\.md "(live)"\)')
FENCE = re.compile(r"^\s*(```+|~~~+)")


def convert(text: str, known: dict[str, str], page: str) -> str:
    def replace(match: re.Match) -> str:
        latex = match["block"] or match["inline"]
        if latex is None:
            return match[0]
        if latex not in known:
            sys.exit(f"{page}: formulas.json lacks {latex!r}; SNAPSHOTS=overwrite cargo test --test book")
        mathml = known[latex]
        if match["inline"]:
            mathml = mathml.replace('display="block"', 'display="inline"', 1)
        # A bar would end a cell of a table.
        return mathml.replace("|", "&#124;")

    def frame(match: re.Match) -> str:
        shown = "?" + match["shown"].replace("&", "&amp;") if match["shown"] else ""
        return (
            f'<iframe class="live" style="height: {match["height"]}px" src="live.html{shown}" '
            f'title="{match["name"]}" loading="lazy"></iframe>'
        )

    lines, fence = [], None
    for line in text.split("\n"):
        mark = FENCE.match(line)
        if mark and fence is None:
            fence = mark[1]
        elif mark and mark[1].startswith(fence):
            fence = None
        elif fence is None:
            line = FILE.sub(r"](\1.html)", LIVE.sub(frame, FORMULA.sub(replace, line)))
        lines.append(line)
    return "\n".join(lines)


def walk(items: list, known: dict[str, str]) -> None:
    for item in items:
        chapter = item.get("Chapter") if isinstance(item, dict) else None
        if chapter:
            chapter["content"] = convert(chapter["content"], known, chapter["path"])
            walk(chapter["sub_items"], known)


def main() -> None:
    if sys.argv[1:2] == ["supports"]:
        return
    _, book = json.load(sys.stdin)
    known = json.loads(Path(__file__).with_name("formulas.json").read_text(encoding="utf-8"))
    walk(book.get("items") or book["sections"], known)
    json.dump(book, sys.stdout)


main()
