"""Drives as they are stated: files, texts, dictionaries and overrides."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Union

import numpy as np

from ._native import InputError

Drive = Union[str, "os.PathLike[str]", Mapping[str, Any]]
Quantity = Union[str, float, int]

#: A name, a text, overrides ``KEY=VALUE``, and a tolerance.
Stated = tuple[str, str, list[str], float]


def stated(drive: Drive, tolerance: float, overrides: Mapping[str, Any]) -> Stated:
    name, text = read(drive)
    return name, text, [override(key, value) for key, value in overrides.items()], float(tolerance)


def read(drive: Drive) -> tuple[str, str]:
    """The name and the text of a drive file."""
    if isinstance(drive, Mapping):
        return "drive", toml(drive)
    if isinstance(drive, str) and "\n" in drive:
        return "drive", drive
    if isinstance(drive, (str, os.PathLike)):
        path = Path(drive)
        return str(path), path.read_text(encoding="utf-8")
    raise InputError(f"a drive is a path, the text of a drive file or a dict, not {type(drive).__name__}")


def override(key: str, value: Any) -> str:
    """An entry and what stands in its place."""
    return f"{key.replace('__', '.')}={'' if value is None else quantity(key, value)}"


def quantity(name: str, value: Any) -> str:
    """A quantity with its unit, or a number in SI units, as text."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    raise InputError(f"`{name}` is a number or a text with a unit, not {type(value).__name__}")


def toml(tables: Mapping[str, Any]) -> str:
    """A dictionary as a drive file."""
    lines: list[str] = []
    _table(tables, (), lines)
    return "\n".join(lines) + "\n"


def _table(table: Mapping[str, Any], path: tuple[str, ...], lines: list[str]) -> None:
    tables: list[tuple[tuple[str, ...], str, Mapping[str, Any]]] = []
    for key, value in table.items():
        if not isinstance(key, str):
            raise InputError(f"a key of a drive is a text, not {key!r}")
        inner = (*path, key)
        if isinstance(value, Mapping):
            tables.append((inner, "[{}]", value))
        elif isinstance(value, (list, tuple)) and value and all(isinstance(each, Mapping) for each in value):
            tables.extend((inner, "[[{}]]", each) for each in value)
        else:
            lines.append(f"{_key(key)} = {_value('.'.join(inner), value)}")
    for inner, brackets, value in tables:
        lines.extend(["", brackets.format(".".join(_key(key) for key in inner))])
        _table(value, inner, lines)


def _key(key: str) -> str:
    bare = key.replace("_", "").replace("-", "")
    return key if bare.isascii() and bare.isalnum() else json.dumps(key, ensure_ascii=False)


def _value(path: str, value: Any) -> str:
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(_value(path, each) for each in value)}]"
    return quantity(path, value)
