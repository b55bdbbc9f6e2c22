"""Nothing drifts: every public name has its docs, its types, its line in the README, and a test."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
import re
import types
from pathlib import Path

import pytest

import closeranks as cr
from closeranks import _native

HERE = Path(__file__).resolve().parent
PAGES = (HERE.parent / "README.md").read_text() + (HERE.parents[2] / "docs/python.md").read_text()
TESTS = "\n".join(path.read_text() for path in sorted(HERE.glob("test_*.py")) if path.name != Path(__file__).name)


def public(owner: object) -> list[str]:
    """Public names of a class, or of a module by its `__all__`."""
    if isinstance(owner, types.ModuleType):
        return list(owner.__all__)
    return [name for name in vars(owner) if not name.startswith("_")]


def names() -> list[tuple[str, object, object]]:
    """Every public name with what it is and its owner."""
    found: list[tuple[str, object, object]] = [(name, getattr(cr, name), cr) for name in public(cr) if not name.startswith("__")]
    for owner in [each for _, each, _ in found if isinstance(each, (type, types.ModuleType))]:
        found += [(name, inspect.getattr_static(owner, name), owner) for name in public(owner)]
    return found


@pytest.mark.parametrize(("name", "what", "owner"), names(), ids=lambda each: each if isinstance(each, str) else "")
def test_every_public_name_is_tested(name: str, what: object, owner: object) -> None:
    assert re.search(rf"\b{name}\b", TESTS), f"no test has {name}"


def test_every_public_name_has_docs() -> None:
    # Fields of named tuples and data classes carry theirs as the string below them, which Python does not keep.
    missing = []
    for name, what, owner in names():
        text = inspect.getdoc(what) if not isinstance(what, (types.MemberDescriptorType, types.GetSetDescriptorType)) else ""
        is_field = isinstance(owner, type) and (issubclass(owner, tuple) or hasattr(owner, "__dataclass_fields__"))
        is_slot = isinstance(what, (types.MemberDescriptorType, types.GetSetDescriptorType))
        if not text and not (is_field or is_slot):
            missing.append(f"{getattr(owner, '__name__', owner)}.{name}")
    assert missing == []


def test_every_public_name_of_the_package_is_in_the_pages() -> None:
    assert [name for name in public(cr) if not name.startswith("__") and name not in PAGES] == []


def test_everything_native_is_used_and_nothing_else() -> None:
    sources = "\n".join(path.read_text() for path in sorted(Path(cr.__file__).parent.glob("*.py")))
    unused = [name for name in dir(_native) if not name.startswith("_") and name not in sources]
    assert [name for name in unused if name not in ("MESSAGE_BYTES", "NODE_LIMIT")] == []
    assert (_native.MESSAGE_BYTES, _native.NODE_LIMIT) == (32, 128)


@pytest.mark.parametrize("module", [each.name for each in pkgutil.iter_modules(cr.__path__) if each.name != "_native"])
def test_examples_in_docs_are_true(module: str) -> None:
    found = doctest.testmod(importlib.import_module(f"closeranks.{module}"))
    assert found.failed == 0


def test_files_and_functions_stay_small() -> None:
    long = []
    for path in [*Path(cr.__file__).parent.glob("*.py"), *HERE.glob("*.py")]:
        lines = path.read_text().splitlines()
        assert lines[0].startswith('"""'), f"{path.name} does not begin by saying what it is"
        if len(lines) > 400:
            long.append(f"{path.name}: {len(lines)} lines")
    assert long == []
