"""The live page as one file: page.py FOLDER makes FOLDER/live.html from FOLDER/live.wasm and the parts in page/."""

import base64
import hashlib
import lzma
import pathlib
import re
import sys


def number(data, at):
    """An unsigned number of variable length, and where it ends."""
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return value, at


def bare(module):
    """The module without custom sections, which say nothing to a browser."""
    kept, at = bytearray(module[:8]), 8
    while at < len(module):
        length, begin = number(module, at + 1)
        if module[at] != 0:
            kept += module[at : begin + length]
        at = begin + length
    return bytes(kept)


def lean(text):
    """Without indentation and lines of comments: no text of them goes over several lines."""
    lines = (line.strip() for line in text.splitlines())
    return "\n".join(line for line in lines if line and not re.match(r"//|/\*\*? .*\*/$", line)) + "\n"


# What a page cannot hold as text: it reads the first as another character, the second as the end of a line, and the third may
# begin a tag.
ILLEGAL = [0, ord("\r"), ord("<")]


def written(data):
    """Bytes as text of a page, a seventh longer in UTF-8, where base64 is a third longer: seven bits a character; an illegal one is
    a character of two bytes that says which, and the next seven bits."""
    count = -(-len(data) * 8 // 7)
    groups = (int.from_bytes(data[k : k + 7].ljust(7, b"\0"), "big") for k in range(0, len(data), 7))
    sevens = [group >> shift & 127 for group in groups for shift in range(49, -7, -7)][:count]
    # Its last bits may be no data.
    if len(data) % 7 and sevens[-1] in ILLEGAL:
        sevens[-1] += 1
    each = iter(sevens)
    return "".join(chr(128 + 128 * ILLEGAL.index(one) + next(each, 0)) if one in ILLEGAL else chr(one) for one in each)


folder = pathlib.Path(sys.argv[1])
module = bare((folder / "live.wasm").read_bytes())
# Packed with LZMA, a quarter smaller than with gzip.
packer = {"id": lzma.FILTER_LZMA1, "preset": 9 | lzma.PRESET_EXTREME, "lc": 3, "lp": 0, "pb": 0}
packed = len(module).to_bytes(4, "big") + lzma.compress(module, lzma.FORMAT_RAW, filters=[packer])
here = pathlib.Path(__file__).parent
parts = {
    "REPORT_CSS": lean((here / "../templates/report.css").read_text()),
    "LIVE_CSS": lean((here / "page/live.css").read_text()),
    "LIVE_JS": "".join(lean((here / f"page/{part}.js").read_text()) for part in ["shared", "unpack", "running", "one", "several", "live"]),
    "LIVE_MODULE": written(packed),
}
page = (here / "page/live.html").read_text()
for part, text in parts.items():
    page = page.replace(part, text, 1)


def hashes(tag):
    """What the page's own policy allows: its elements of this name, by their text. The module is data."""
    texts = re.findall(f"<{tag}(?: id=[^>]*)?>(.*?)</{tag}>", page, re.DOTALL)
    digests = (hashlib.sha256(text.encode()).digest() for text in texts)
    return " ".join(f"'sha256-{base64.b64encode(digest).decode()}'" for digest in digests)


page = page.replace("STYLE_HASHES", hashes("style"), 1).replace("SCRIPT_HASHES", hashes("script"), 1)
out = folder / "live.html"
out.write_text(page)
size = len(page.encode())
print(f"{out.name}: {size / 1e6:.3f} MB")
if size > 1_800_000:
    sys.exit("the page may have 1.8 MB")
