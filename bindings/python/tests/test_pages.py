"""The code of the pages runs, block after block, as a reader would run it; it says nothing that is not so."""

from __future__ import annotations

import contextlib
import io
import os
import re
from pathlib import Path

import pytest

from conftest import ROOT

PAGES = ["bindings/python/README.md", "docs/python.md"]


def blocks(page: str) -> list[tuple[str, str, int]]:
    """Fenced blocks: language, text, line."""
    text = (ROOT / page).read_text()
    found = re.finditer(r"^```(\w+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return [(block[1], block[2], text[: block.start()].count("\n") + 2) for block in found]


@pytest.mark.parametrize("page", PAGES)
def test_the_code_of_a_page_runs(page: str, tmp_path: Path) -> None:
    names: dict[str, object] = {}
    with contextlib.chdir(tmp_path) if hasattr(contextlib, "chdir") else _chdir(tmp_path):
        said = io.StringIO()
        for language, text, line in blocks(page):
            if language == "python":
                said = io.StringIO()
                code = compile("\n" * (line - 1) + text, page, "exec")
                with contextlib.redirect_stdout(said):
                    exec(code, names)
            elif language == "text":
                assert said.getvalue() == text, f"{page}:{line}: the block before it prints something else"
    written = {name for _, text, _ in blocks(page) for name in re.findall(r'savefig\("(.+?)"\)', text)}
    assert {path.name for path in tmp_path.iterdir()} >= written != set()


@contextlib.contextmanager
def _chdir(folder: Path):  # type: ignore[no-untyped-def]
    before = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)
