"""What tests have in common."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import closeranks as cr

ROOT = Path(__file__).resolve().parents[3]
"""The repository."""


@pytest.fixture(scope="session")
def nominal() -> cr.Run:
    """The paper's nominal run."""
    return cr.Scenario.paper("nominal").run(progress=False)


@pytest.fixture(scope="session")
def program() -> Path:
    """The command line, built from the same commit."""
    named = os.environ.get("CLOSERANKS")
    if named is not None:
        assert Path(named).is_file(), f"CLOSERANKS names {named}, which is not there"
        return Path(named)
    for profile in ("release", "debug"):
        built = ROOT / "target" / profile / "closeranks"
        if built.is_file():
            return built
    pytest.skip("the command line is not built: cargo build --release, or CLOSERANKS=path")
