"""Files of users, read with a bound."""

from __future__ import annotations

from pathlib import Path

from closeranks import _native

_TEXT_MAX = 1 << 20
_FILE_MAX = 1 << 18

Beside = list[tuple[str, str | None, str]]
"""Files beside a scenario: name, text, and why there is no text."""


def scenario_with_files(path: Path) -> tuple[str, Beside]:
    """The text of a scenario, with or without draws, and the files that it names."""
    text = _text(path, "scenario", _TEXT_MAX)
    files: Beside = []
    for name in _native.named(text):
        try:
            files.append((name, _text(path.parent / name, "file", _FILE_MAX), ""))
        except (OSError, _native.ScenarioError) as error:
            files.append((name, None, str(error)))
    return text, files


def _text(path: Path, what: str, most: int) -> str:
    """The text of a file of at most so many bytes, refused in the words of the command line."""
    with path.open("rb") as file:
        data = file.read(most + 1)
    if len(data) > most:
        raise _native.ScenarioError(f"the {what} `{path}` is too long: allowed is at most {most} bytes")
    try:
        return data.decode()
    except UnicodeDecodeError as error:
        raise _native.ScenarioError(f"the {what} `{path}` is not text: byte {error.start} is not UTF-8") from None
