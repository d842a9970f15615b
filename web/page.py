"""A live page as one file: page.py FOLDER NAME makes FOLDER/NAME.html from FOLDER/NAME.wasm and the parts in page/."""

import base64
import hashlib
import pathlib
import re
import subprocess
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


folder, name = pathlib.Path(sys.argv[1]), sys.argv[2]
module, out = folder / "bare.wasm", folder / f"{name}.html"
module.write_bytes(bare((folder / f"{name}.wasm").read_bytes()))
packed = subprocess.run(["zopfli", "--i5", "-c", module], check=True, capture_output=True).stdout
here = pathlib.Path(__file__).parent
parts = {
    "REPORT_CSS": lean((here / "../templates/report.css").read_text()),
    "LIVE_CSS": lean((here / "page/live.css").read_text()),
    "LIVE_MODULE": base64.b64encode(packed).decode(),
    "LIVE_JS": "".join(lean((here / f"page/{part}.js").read_text()) for part in ["shared", name]),
}
page = (here / f"page/{name}.html").read_text()
for part, text in parts.items():
    page = page.replace(part, text, 1)


def hashes(tag):
    """What the page's own policy allows: its elements of this name, by their text. The module is data."""
    texts = re.findall(f"<{tag}(?: id=[^>]*)?>(.*?)</{tag}>", page, re.DOTALL)
    digests = (hashlib.sha256(text.encode()).digest() for text in texts)
    return " ".join(f"'sha256-{base64.b64encode(digest).decode()}'" for digest in digests)


page = page.replace("STYLE_HASHES", hashes("style"), 1).replace("SCRIPT_HASHES", hashes("script"), 1)
out.write_text(page)
size = len(page.encode())
print(f"{out.name}: {size / 1e6:.3f} MB")
if size > 1_800_000:
    sys.exit("the page may have 1.8 MB")
