"""Steady mechanics of belt drives: slip, creep, tensions, torque, wrap angles and limits.

Each function asks one question of one drive and takes:

``drive``
    A drive file: its path, its text (a ``str`` with a line break), or a ``dict`` of its tables. Quantities are
    strings with units, ``"120 kN"``; a bare number is in SI units, an angle in radians.
``tolerance``
    Relative tolerance of each steady state, 1e-12 to 1e-2.
``**overrides``
    Entries in place of those of the drive file, by their dotted paths with two underscores for each dot:
    ``load__tight_tension="2 kN"``, or ``**{"pulley.fan-2.torque": "12 N*m"}``. ``None`` leaves an entry out.

and returns an :class:`Answer`. Keys of answers end in their units: ``torque_N_m``, ``wrap_angle_deg``.
An :class:`InputError` says what is at fault, an :class:`UnsolvedError` why there is no steady state.
"""

from ._native import InputError, Table, UnsolvedError, example, examples
from ._answer import Answer, Record
from ._stated import Drive
from ._questions import (
    calibrate,
    check,
    design,
    limits,
    map,
    modes,
    rating,
    report,
    sections,
    simulate,
    solve,
    solve_table,
    stability,
    tension,
    trace,
    verify,
)

__all__ = [
    "Answer",
    "Drive",
    "InputError",
    "Record",
    "Table",
    "UnsolvedError",
    "calibrate",
    "check",
    "design",
    "example",
    "examples",
    "limits",
    "map",
    "modes",
    "rating",
    "report",
    "sections",
    "simulate",
    "solve",
    "solve_table",
    "stability",
    "tension",
    "trace",
    "verify",
]
