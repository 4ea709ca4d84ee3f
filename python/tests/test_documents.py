"""What the documents show is what happens: the pages of the guide, the READMEs and the notebook."""

import ast
import contextlib
import io
import subprocess
import sys

import pytest
import slapstick
from beside import HANGS
from conftest import ROOT

sys.path.insert(0, str(ROOT / "test/library"))
PAGES = [str(path.relative_to(ROOT)) for path in sorted(ROOT.glob("docs/**/*.md")) if "\n```python\n" in path.read_text()]


@pytest.mark.parametrize("path", ["README.md", "python/README.md", *PAGES])
def test_programs_of_a_page_print_what_stands_below_them(path, tmp_path, monkeypatch):
    import printed

    text = (ROOT / path).read_text()
    printed.write_files(text, tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    blocks = [(kind, "\n".join(lines)) for kind, lines, _ in printed.fences(text) if kind is not None or "".join(lines).strip()]
    variables, ran = {}, 0
    for (kind, program), (next_kind, shown) in zip(blocks, [*blocks[1:], ("", "")]):
        if kind != "python":
            continue
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(compile(program, path, "exec"), variables)
        ran += 1
        if next_kind == "" and shown:
            assert output.getvalue().rstrip("\n") == shown.rstrip("\n")
    assert ran > 0
    assert [name for name in printed.pictures(text)[1] if not (tmp_path / name).exists()] == []


def test_the_page_names_every_call():
    page = (ROOT / "docs/reference/python.md").read_text()
    calls = [name for name in slapstick.__all__ if not name.startswith("_") and name[0].islower()]
    assert [name for name in calls if f"`{name}`" not in page] == []


def test_the_notebook_draws_the_main_figure_and_the_branch_in_ten_lines():
    import nbclient
    import nbformat

    notebook = nbformat.read(ROOT / "python/notebooks/first_figures.ipynb", as_version=4)
    code = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
    assert sum(bool(line.strip()) for cell in code for line in cell.splitlines()) <= 10
    assert all(ast.parse(cell) for cell in code)
    # What the figures show, asked of the same kernel after the notebook's own cells.
    notebook.cells.append(
        nbformat.v4.new_code_cell(
            "import json\n"
            "print(json.dumps([len(impacts), len(set(impacts.value.tolist())), "
            "[(point.type, round(point.value, 5)) for point in branch.special]]))"
        )
    )
    nbclient.NotebookClient(notebook, timeout=HANGS, kernel_name="python3").execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    pictures = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) == 2 and all(len(output["data"]["image/png"]) > 20_000 for output in pictures)
    assert sum("<table>" in output.get("data", {}).get("text/html", "") for output in outputs) == 1
    rows, values, special = ast.literal_eval(outputs[-1]["text"])
    assert values == 1200 and rows > 200_000
    assert ["PD", 2.84596] in special


@pytest.mark.parametrize("page", ["first_motion", "attractors", "unstable_orbit", "curve"])
def test_notebooks_of_the_tutorial_are_its_pages_and_run(page, tmp_path):
    import nbclient
    import nbformat

    subprocess.run([sys.executable, "-B", ROOT / "tools/make_notebooks", tmp_path], check=True)
    kept = ROOT / f"python/notebooks/{page}.ipynb"
    assert kept.read_text() == (tmp_path / kept.name).read_text()
    notebook = nbformat.read(kept, as_version=4)
    nbclient.NotebookClient(notebook, timeout=HANGS, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert any(cell.get("outputs") for cell in notebook.cells)
