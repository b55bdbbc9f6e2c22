"""Notebooks run from the first cell to the last, here with fewer starts, and write what the pages show."""

from __future__ import annotations

from pathlib import Path

import pytest

from conftest import ROOT

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")


# Of what notebooks run on, and not ours.
@pytest.mark.filterwarnings("ignore")
def test_the_study_of_many_starts_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("STARTS", "24")
    monkeypatch.setenv("STARTS_FILE", str(ROOT / "scenarios/starts.toml"))
    monkeypatch.setenv("MPLBACKEND", "agg")
    notebook = nbformat.read(ROOT / "bindings/python/examples/study.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "it is committed without outputs"
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    made = (tmp_path / "study.md").read_text().splitlines()
    page = (ROOT / "docs/study.md").read_text().splitlines()
    questions = [line.split("|")[1] for line in made]
    assert [line.split("|")[1] for line in page if line.startswith("|")][: len(questions)] == questions, "the page has its table"
    starts = next(line for line in made if line.startswith("| starts"))
    assert starts == "| starts | 24 | 24 |"
    kept = next(line for line in made if "keep F'" in line)
    assert kept.count("1.0000 [") == 2, "no normal robot fell below F' in any run"
    assert "<svg" in (tmp_path / "study.svg").read_text()
