"""The page of the book and the notebook run as they stand."""

import re

import nbclient
import nbformat
import pytest
from conftest import ROOT

PAGE = ROOT / "docs" / "src" / "python.md"
NOTEBOOKS = sorted((ROOT / "python" / "examples").glob("*.ipynb"))


def test_the_page_runs(tmp_path, monkeypatch):
    """Blocks of Python one after the other, in an empty folder with the cases that the page names."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    for name, case in [("damper.toml", "li2016-8hz-b7p5mm.toml"), ("mast.toml", "several/mast.toml")]:
        (tmp_path / name).write_text((ROOT / "cases" / case).read_text())
    lines = PAGE.read_text().splitlines()
    blocks = re.finditer(r"(?ms)^```python\n(.*?)^```$", "\n".join(lines) + "\n")
    names: dict[str, object] = {}
    count = 0
    for count, block in enumerate(blocks, 1):
        # Errors name the line of the page.
        begin = block.string[: block.start(1)].count("\n")
        exec(compile("\n" * begin + block[1], PAGE, "exec"), names)
        # What a comment behind a line says is what the line gives: `expression  # -> value`.
        for line in block[1].splitlines():
            shown = re.fullmatch(r"(\S.*?)  # -> (.*)", line)
            if shown:
                assert repr(eval(shown[1], names)) == shown[2], line
    assert count > 5 and (tmp_path / "figure.png").stat().st_size > 1000


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_notebook_runs(path):
    notebook = nbformat.read(path, as_version=4)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            assert cell.outputs == [] and cell.execution_count is None, "notebooks are kept without outputs"
    nbclient.NotebookClient(notebook, timeout=300).execute()
    figures = [one for cell in notebook.cells for one in cell.get("outputs", []) if "image/png" in one.get("data", {})]
    assert len(figures) == 3
