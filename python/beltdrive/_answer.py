"""Answers: values by their keys, as attributes, items and tables."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any, Literal, Protocol

import numpy as np

from ._native import Numbers

Units = Literal["si", "engineering", "us"]


class Record(Mapping[str, Any]):
    """Values by their keys, as items and as attributes: ``record["torque_N_m"]`` is ``record.torque_N_m``.

    A key ends in its unit: ``_m``, ``_N``, ``_N_m``, ``_W``, ``_rad_per_s``; angles are in degrees (``_deg``). Values
    along the belt and components along x and y are NumPy arrays, other lists are lists of records, and what is not
    known is ``None``.
    """

    __slots__ = ("_values",)

    def __init__(self, values: Mapping[str, Any]) -> None:
        object.__setattr__(self, "_values", {key: _held(value) for key, value in values.items()})

    def __getitem__(self, key: str) -> Any:
        return self._values[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or name == "_values":
            raise AttributeError(name)
        try:
            return self._values[name]
        except KeyError:
            raise AttributeError(f"there is no value `{name}`; expected one of {', '.join(self)}") from None

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("an answer cannot be changed")

    def to_dict(self) -> dict[str, Any]:
        """The values as dictionaries, lists, numbers and words."""
        return {key: _plain(value) for key, value in self.items()}

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(key for key in self if key.isidentifier())]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{key}={_short(value)}' for key, value in self.items())})"

    def __reduce__(self) -> tuple[Any, ...]:
        return Record, (self._values,)


class _Told(Protocol):
    """What tells an answer."""

    def values(self) -> dict[str, Any]: ...
    def heading(self) -> list[str]: ...
    def table(self, units: str) -> str: ...
    def html(self, units: str) -> str: ...
    def json(self) -> str: ...
    def csv(self) -> str: ...
    @property
    def drive_file(self) -> str | None: ...


class Answer(Record):
    """What was found: a :class:`Record` that prints as the table of the program and shows as HTML in notebooks."""

    __slots__ = ("_told",)

    def __init__(self, told: _Told) -> None:
        object.__setattr__(self, "_told", told)

    def __getattr__(self, name: str) -> Any:
        if name == "_values":
            # Nothing is converted until it is asked for.
            super().__init__(self._told.values())
            return object.__getattribute__(self, "_values")
        return super().__getattr__(name)

    @property
    def drive_file(self) -> str | None:
        """The drive file that was found, as text: that of :func:`design` where a drive meets all limits."""
        return self._told.drive_file

    def to_dict(self) -> dict[str, Any]:
        """Everything as dictionaries, lists, numbers and words: the JSON of the program, without its origin."""
        return json.loads(self._told.json())

    def to_json(self) -> str:
        """Everything as JSON at full precision."""
        return self._told.json()

    def to_csv(self) -> str:
        """The rows as CSV: the points of profiles, branches and maps, load cases, readings."""
        return self._told.csv()

    def table(self, units: Units = "engineering") -> str:
        """The table of the program, with the digits that are known, in a system of units."""
        return self._told.table(units)

    def to_html(self, units: Units = "engineering") -> str:
        """The same as tables in HTML."""
        return self._told.html(units)

    def __str__(self) -> str:
        return self.table()

    def __repr__(self) -> str:
        return f"<Answer: {next(iter(self._told.heading()), 'without a heading')}>"

    def _repr_html_(self) -> str:
        return self.to_html()

    def __reduce__(self) -> tuple[Any, ...]:
        systems: tuple[Units, ...] = ("si", "engineering", "us")
        texts = {
            "heading": self._told.heading(),
            "tables": {units: self._told.table(units) for units in systems},
            "htmls": {units: self._told.html(units) for units in systems},
            "json": self._told.json(),
            "csv": self._told.csv(),
            "drive_file": self._told.drive_file,
        }
        return _restored, (dict(self._values), texts)


class _Restored:
    """What told an answer in another process."""

    def __init__(self, values: dict[str, Any], texts: dict[str, Any]) -> None:
        self._held, self._texts = values, texts

    def values(self) -> dict[str, Any]:
        return self._held

    def heading(self) -> list[str]:
        return self._texts["heading"]

    def table(self, units: str) -> str:
        return self._texts["tables"][units]

    def html(self, units: str) -> str:
        return self._texts["htmls"][units]

    def json(self) -> str:
        return self._texts["json"]

    def csv(self) -> str:
        return self._texts["csv"]

    @property
    def drive_file(self) -> str | None:
        return self._texts["drive_file"]


def _restored(values: dict[str, Any], texts: dict[str, Any]) -> Answer:
    return Answer(_Restored(values, texts))


def _held(value: Any) -> Any:
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list):
        return [_held(each) for each in value]
    if isinstance(value, Numbers):
        return np.asarray(value)
    return value


def _plain(value: Any) -> Any:
    if isinstance(value, Record):
        return value.to_dict()
    if isinstance(value, list):
        return [_plain(each) for each in value]
    return value.tolist() if isinstance(value, np.ndarray) else value


def _short(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"array of {value.size}" if value.size > 3 else repr(value.tolist())
    if isinstance(value, list):
        return f"list of {len(value)}"
    return repr(value)
