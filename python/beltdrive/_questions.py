"""The questions: what the commands of the program ask, as functions."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, Optional, Union

from . import _native
from ._answer import Answer, Units
from ._native import InputError, Table
from ._stated import Drive, Quantity, quantity, stated

#: A number of the drive file by its dotted path, both ends of its range with their units, how many values it takes.
Axis = tuple[str, Quantity, Quantity, int]


def solve(drive: Drive, *, tolerance: float = 1e-6, **overrides: Any) -> Answer:
    """In which steady state does this drive run?

    A drive with two pulleys has ``driver`` and ``driven``, with speeds (rad/s), torques (N m) and wrap angles (deg), and
    ``profiles``, arrays along each pulley; any drive has ``pulleys``, ``spans`` and ``loop``. ``checks`` and
    ``convergence`` say how well the state is known.

    >>> import beltdrive
    >>> state = beltdrive.solve(beltdrive.example("kim2009"))
    >>> round(state.driven.angular_speed_rad_per_s, 4)
    102.6994
    """
    return Answer(_native.solve(stated(drive, tolerance, overrides)))


def solve_table(
    drive: Drive,
    table: Any,
    *,
    question: Literal["solve", "check", "limits"] = "solve",
    keep: Iterable[str] = (),
    tolerance: float = 1e-6,
    **overrides: Any,
) -> Table:
    """The answers for many drives, which differ from one in some of its numbers.

    ``table`` is any object with the PyCapsule interface of Arrow: a table of pyarrow, a data frame of polars or of
    pandas. A column is a number of the drive file by its dotted path, with its unit in brackets where it is not SI,
    ``"load.torque [N*m]"``; or by its name in the answers, ``"load_torque_N_m"``; or ``"load_factor"``. Columns named in
    ``keep`` are carried over, whatever they hold.

    The rows of the answer are those of the table, in their order and on all processors: ``row`` from 0, the numbers
    that vary, the numbers of the answer under their keys with units, and ``status``: ``"answered"``, ``"no answer"`` or
    ``"at fault"``, the last two with a ``reason`` and a ``description``. The metadata of its schema hold the drive file
    and the version of the program. ``RAYON_NUM_THREADS`` bounds the processors.
    """
    keep = [keep] if isinstance(keep, str) else list(keep)
    return _native.solve_table(stated(drive, tolerance, overrides), table, question, keep)


def check(drive: Drive, *, samples: Optional[int] = None, tolerance: float = 1e-6, **overrides: Any) -> Answer:
    """Does it hold in each load case, and where does the power go?

    ``cases`` has a ``verdict`` for each, ``"holds"`` or ``"FAILS"``; a drive that fails raises no exception. With ``samples``, so many draws of
    what ``[uncertainty]`` says is not known exactly stand beside the linearised bands of 95 %.
    """
    return Answer(_native.check(stated(drive, tolerance, overrides), samples))


def report(
    drive: Drive,
    *,
    samples: Optional[int] = None,
    units: Units = "engineering",
    tolerance: float = 1e-6,
    **overrides: Any,
) -> str:
    """What do I hand in? The page of :func:`check` in HTML, with figures, as text."""
    given = stated(drive, tolerance, overrides)
    arguments = [repr(given[0]), *(f"{key}={value!r}" for key, value in overrides.items() if key.isidentifier())]
    others = {key: value for key, value in overrides.items() if not key.isidentifier()}
    arguments.extend([f"**{others!r}"] if others else [])
    return _native.report(given, samples, units, f"beltdrive.report({', '.join(arguments)})")


def tension(
    drive: Drive,
    *,
    margin: Optional[float] = None,
    elongation: float = 0.005,
    move: Optional[str] = None,
    samples: Optional[int] = None,
    tolerance: float = 1e-6,
    **overrides: Any,
) -> Answer:
    """How tight do I set it up, and what does a gauge then read?

    ``margin`` is the smallest factor on all torques at which a pulley may slip, at least 1, in place of that of the
    file; ``elongation`` the share of its length by which the belt grows in service; ``move`` the pulley whose centre is
    moved to tension the belt.
    """
    return Answer(_native.tension(stated(drive, tolerance, overrides), margin, elongation, move, samples))


def rating(
    drive: Drive,
    start: Optional[Quantity] = None,
    stop: Optional[Quantity] = None,
    *,
    samples: Optional[int] = None,
    tolerance: float = 1e-6,
    **overrides: Any,
) -> Answer:
    """What can it carry at each speed, why no more, and at which speed most?

    ``start`` and ``stop`` are speeds of the driver; without ``stop`` the range ends where the belt lifts off.
    """
    ends = [None if end is None else quantity(name, end) for name, end in (("start", start), ("stop", stop))]
    return Answer(_native.rating(stated(drive, tolerance, overrides), ends[0], ends[1], samples))


def modes(
    drive: Drive,
    count: int = 8,
    start: Optional[Quantity] = None,
    stop: Optional[Quantity] = None,
    **overrides: Any,
) -> Answer:
    """At which frequencies does the running belt vibrate, and how fast do they die out?

    The ``count`` lowest axial and torsional modes, 1 to 40, about the steady state of a flat belt with
    elastic/perfectly-plastic or creep-rate friction, and the transverse frequencies of its spans; with ``stop``, also
    over speeds of the driver from ``start``, a tenth of ``stop`` unless given. ``[transient]`` of the drive file gives
    the inertia of the pulleys.
    """
    ends = [None if end is None else quantity(name, end) for name, end in (("start", start), ("stop", stop))]
    return Answer(_native.modes(stated(drive, 1e-6, overrides), count, ends[0], ends[1]))


def simulate(
    drive: Drive,
    until: Optional[Quantity] = None,
    *,
    at: Sequence[Quantity] = (),
    tolerance: float = 1e-6,
    **overrides: Any,
) -> Answer:
    """What happens over time, as ``[transient]`` of the drive file says what the pulleys do?

    ``until`` is a time or ``"steady"``, in place of ``transient.end``; ``at`` the times at which tension and friction
    along the belt are kept.
    """
    end = None if until is None else quantity("until", until)
    return Answer(_native.simulate(stated(drive, tolerance, overrides), end, [quantity("at", time) for time in at]))


def limits(drive: Drive, *, parameter: Optional[str] = None, tolerance: float = 1e-6, **overrides: Any) -> Answer:
    """Which loads does the drive carry, and what happens at the limit?

    ``parameter`` is the number of the drive file that is varied, by its dotted path; unless given it is the load.
    """
    return Answer(_native.limits(stated(drive, tolerance, overrides), parameter))


def trace(
    drive: Drive,
    parameter: str,
    start: Quantity,
    stop: Quantity,
    *,
    curve: Optional[str] = None,
    tolerance: float = 1e-6,
    **overrides: Any,
) -> Answer:
    """How does the state change with a number of the drive file?

    The branch of steady states over ``parameter`` from ``start`` to ``stop``, around limit points. With ``curve``, a
    second number, the limit of ``parameter`` over values of that from ``start`` to ``stop``. A branch of which the next
    state was not found ends there, with a warning.
    """
    given = stated(drive, tolerance, overrides)
    return Answer(_native.trace(given, parameter, quantity("start", start), quantity("stop", stop), curve))


def map(
    drive: Drive,
    x: Optional[Axis] = None,
    y: Optional[Axis] = None,
    *,
    tolerance: float = 1e-6,
    **overrides: Any,
) -> Answer:
    """How does the drive behave over two of its numbers, load and speed unless given?

    An axis is ``("load.power", "1 kW", "5 kW", 20)``: a number by its dotted path, or ``"load_factor"``, both ends and
    how many values it takes.
    """
    return Answer(_native.map(stated(drive, tolerance, overrides), _axis("x", x), _axis("y", y)))


def design(drive: Drive, *, tolerance: float = 1e-6, **overrides: Any) -> Answer:
    """What should I build, and what does each limit cost?

    ``[design]`` of the drive file says what is to be small and what is free. :attr:`Answer.drive_file` is the drive
    file with the values found; ``None`` if no drive meets all limits.
    """
    return Answer(_native.design(stated(drive, tolerance, overrides)))


def calibrate(
    drive: Drive,
    data: Union[str, "os.PathLike[str]", Mapping[str, Iterable[Any]]],
    *,
    free: Iterable[str] = (),
    tolerance: float = 1e-6,
    **overrides: Any,
) -> Answer:
    """Which friction and stiffness do my measurements say?

    ``data`` is a CSV file, its text, or columns: a dict or a data frame. Headings name numbers with units, such as
    ``"load.torque [N*m]"`` and ``"driven.angular_speed [rpm]"``. ``free`` are the numbers to find, by their dotted
    paths, in place of those of ``calibration.free``.
    """
    name, text = _measured(data)
    return Answer(_native.calibrate(stated(drive, tolerance, overrides), name, text, list(free)))


def stability(drive: Drive, *, modes: int = 12, **overrides: Any) -> Answer:
    """Do small axial motions of a flat belt grow? The lowest ``modes`` on each pulley, 1 to 60."""
    return Answer(_native.stability(stated(drive, 1e-6, overrides), modes))


def sections(name: Optional[str] = None) -> Answer:
    """What are the numbers of a belt section, and who says so? All sections, or one in full with its sources."""
    return Answer(_native.sections(name))


def verify() -> Answer:
    """How do the results compare with published ones? Computes each published number again; takes some seconds."""
    return Answer(_native.verify())


def _axis(name: str, axis: Optional[Axis]) -> Optional[tuple[str, str, str, int]]:
    if axis is None:
        return None
    try:
        key, start, stop, count = axis
    except (TypeError, ValueError):
        raise InputError(f"{name} is (key, start, stop, count), not {axis!r}") from None
    return key, quantity(name, start), quantity(name, stop), count


def _measured(data: Any) -> tuple[str, str]:
    if hasattr(data, "items"):
        columns = {str(name): list(values) for name, values in data.items()}
        if len({len(column) for column in columns.values()}) > 1:
            raise InputError("the columns of the data differ in length")
        text = io.StringIO()
        writer = csv.writer(text)
        writer.writerow(columns)
        # An empty field is a reading that there is not.
        writer.writerows(["" if each is None or each != each else each for each in row] for row in zip(*columns.values()))
        return "data", text.getvalue()
    if isinstance(data, str) and "\n" in data:
        return "data", data
    if isinstance(data, (str, os.PathLike)):
        path = Path(data)
        return str(path), path.read_text(encoding="utf-8")
    raise InputError(f"data are a path, a text in CSV or columns, not {type(data).__name__}")
