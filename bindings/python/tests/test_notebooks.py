"""Notebooks run from the first cell to the last, here with fewer starts, and write what the pages show."""

from __future__ import annotations

from pathlib import Path

import pytest

from conftest import ROOT

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")

ROWS = ROOT / "docs/data/study.csv"


def studied(folder: Path, patch: pytest.MonkeyPatch, **fields: str) -> str:
    """Runs the notebook in `folder`; the table that it wrote."""
    for name, value in {"STARTS_FILE": str(ROOT / "scenarios/starts.toml"), "MPLBACKEND": "agg", **fields}.items():
        patch.setenv(name, value)
    notebook = nbformat.read(ROOT / "bindings/python/examples/study.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "it is committed without outputs"
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(folder)}}).execute()
    assert "<svg" in (folder / "study.svg").read_text()
    return (folder / "study.md").read_text()


# Of what notebooks run on, and not ours.
@pytest.mark.filterwarnings("ignore")
def test_the_rows_of_the_study_are_those_that_runs_come_to(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = studied(tmp_path, monkeypatch, STARTS="24").splitlines()
    assert "| starts | 24 | 24 |" in made
    rows, known = (tmp_path / "study.csv").read_text().splitlines(), ROWS.read_text().splitlines()
    assert len(rows) == 1 + 3 * 24 * 2 and len(known) == 1 + 3 * 1200 * 2
    assert rows == known[: len(rows)], "docs/study.md says how to compute docs/data/study.csv anew"


@pytest.mark.filterwarnings("ignore")
def test_the_table_of_the_page_is_that_of_its_rows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = studied(tmp_path, monkeypatch, STUDY_ROWS=str(ROWS))
    assert "| starts | 1200 | 1200 |\n" in made
    assert made in (ROOT / "docs/study.md").read_text()
    assert not (tmp_path / "study.csv").exists()
