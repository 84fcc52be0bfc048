"""Second-order problems with layers, turning points, shocks or several solutions."""

import numpy as np
from numpy import cos, exp, pi, sin, sqrt

from statement import Problem, entries, guessed, second_order, straight, variants, zero


def linear_layers():
    unit, symmetric = (0, 1), (-1, 1)
    for name, e in variants(1, (1e-2, 1e-4, 1e-6)) + [("E11a", 1.0)]:
        yield second_order(
            name, unit, (1, 0),
            lambda x, y, dy, e=e: y / e,
            lambda x, y, dy, e=e: 1 / e,
            zero,
        )
    for name, e in variants(2, (1e-1, 1e-2, 1e-4)):
        yield second_order(
            name, unit, (1, 0),
            lambda x, y, dy, e=e: dy / e,
            zero,
            lambda x, y, dy, e=e: 1 / e,
        )
    for name, e in variants(3, (1e-1, 1e-2, 1e-4)):
        def f(x, y, dy, e=e):
            c = 2 + cos(pi * x)
            return (y - c * dy - (1 + e * pi**2) * cos(pi * x) - c * pi * sin(pi * x)) / e

        yield second_order(
            name, symmetric, (-1, -1), f,
            lambda x, y, dy, e=e: 1 / e,
            lambda x, y, dy, e=e: -(2 + cos(pi * x)) / e,
        )
    for name, e in variants(4, (1e-1, 1e-2, 1e-4)):
        yield second_order(
            name, symmetric, (1 + exp(-2), 1 + exp(-2 * (1 + e) / e)),
            lambda x, y, dy, e=e: ((1 + e) * y - dy) / e,
            lambda x, y, dy, e=e: (1 + e) / e,
            lambda x, y, dy, e=e: -1 / e,
        )
    diffusion = [(name, e, (-1, -1)) for name, e in variants(11, (1e-1, 1e-2, 1e-4))]
    diffusion += [(name, e, (-1, 0)) for name, e in variants(12, (1e-2, 1e-4, 1e-6))]
    thin = variants(14, (1e-2, 1e-4, 1e-6))
    diffusion += [(name, e, 2 * (exp(-2 / sqrt(e)),)) for name, e in thin]
    for name, e, ends in diffusion:
        yield second_order(
            name, symmetric, ends,
            lambda x, y, dy, e=e: (y - (1 + e * pi**2) * cos(pi * x)) / e,
            lambda x, y, dy, e=e: 1 / e,
            zero,
        )
    for name, odd in variants(16, (11, 51, 151)):
        w = pi * odd / 2
        yield second_order(
            name, unit, (0, sin(w)),
            lambda x, y, dy, w=w: -(w**2) * y,
            lambda x, y, dy, w=w: -(w**2),
            zero,
        )
    for name, e in variants(18, (1e-1, 1e-2, 1e-4)):
        yield second_order(
            name, unit, (1, exp(-1 / e)),
            lambda x, y, dy, e=e: -dy / e,
            zero,
            lambda x, y, dy, e=e: -1 / e,
        )


def turning_points():
    symmetric = (-1, 1)
    for name, e in variants(6, (1e-1, 1e-2, 1e-4)):
        yield second_order(
            name, symmetric, (-2, 0),
            lambda x, y, dy, e=e: (
                -x * dy - e * pi**2 * cos(pi * x) - pi * x * sin(pi * x)
            ) / e,
            zero,
            lambda x, y, dy, e=e: -x / e,
        )
    for name, e in variants(7, (1e-2, 1e-4, 1e-5)):
        yield second_order(
            name, symmetric, (-1, 1),
            lambda x, y, dy, e=e: (
                y - x * dy - (1 + e * pi**2) * cos(pi * x) - pi * x * sin(pi * x)
            ) / e,
            lambda x, y, dy, e=e: 1 / e,
            lambda x, y, dy, e=e: -x / e,
        )
    for name, e in variants(9, (1e-1, 1e-2, 1e-4)):
        yield second_order(
            name, symmetric, 2 * (1 / (1 + e),),
            lambda x, y, dy, e=e: -(4 * x * dy + 2 * y) / (e + x**2),
            lambda x, y, dy, e=e: -2 / (e + x**2),
            lambda x, y, dy, e=e: -4 * x / (e + x**2),
        )
    for name, e in variants(15, (1e-2, 1e-3, 1e-5)):
        yield second_order(
            name, symmetric, (1, 1),
            lambda x, y, dy, e=e: x * y / e,
            lambda x, y, dy, e=e: x / e,
            zero,
        )


def nonlinear_layers():
    unit = (0, 1)
    for name, e in variants(19, (1e-1, 1e-2, 1e-3)):
        yield second_order(
            name, unit, (0, 0),
            lambda x, y, dy, e=e: (-exp(y) * dy + pi / 2 * sin(pi * x / 2) * exp(2 * y)) / e,
            lambda x, y, dy, e=e: (-exp(y) * dy + pi * sin(pi * x / 2) * exp(2 * y)) / e,
            lambda x, y, dy, e=e: -exp(y) / e,
        )
    for name, e in variants(21, (1e-1, 1e-2, 1e-4)):
        ends = (1, exp(-1 / sqrt(e)))
        yield second_order(
            name, unit, ends,
            lambda x, y, dy, e=e: (y + y**2 - exp(-2 * x / sqrt(e))) / e,
            lambda x, y, dy, e=e: (1 + 2 * y) / e,
            zero,
            straight(*ends),
        )
    for name, m in variants(23, (5.0, 10.0, 15.0)):
        yield second_order(
            name, unit, (0, 1),
            lambda x, y, dy, m=m: m * np.sinh(m * y),
            lambda x, y, dy, m=m: m**2 * np.cosh(m * y),
            zero,
            straight(0, 1),
        )
    for name, e in variants(24, (5e-2, 2e-2, 5e-3)):
        yield nozzle(name, e)
    shocks = [(26, (1e-1, 2e-2, 5e-3), (1, -1 / 3)), (27, (1e-1, 2e-2, 5e-3), (1, 1 / 3))]
    shocks += [(29, (1e-1, 2e-2, 1e-3), (0, 3 / 2)), (30, (1e-1, 2e-2, 5e-3), (-7 / 6, 3 / 2))]
    for number, values, ends in shocks:
        for name, e in variants(number, values):
            yield second_order(
                name, unit, ends,
                lambda x, y, dy, e=e: y * (1 - dy) / e,
                lambda x, y, dy, e=e: (1 - dy) / e,
                lambda x, y, dy, e=e: -y / e,
                straight(*ends),
            )


def nozzle(name, e):
    """A shock in a nozzle of area 1 + x^2, ratio of specific heats 1.4."""
    gamma, ends = 1.4, (0.9129, 0.375)

    def f(x, y, dy):
        area, slope = 1 + x**2, 2 * x
        flow = ((1 + gamma) / 2 - e * slope) * y * dy - dy / y
        return (flow - slope / area * (1 - (gamma - 1) / 2 * y**2)) / (e * area * y)

    def f_y(x, y, dy):
        area, slope = 1 + x**2, 2 * x
        flow = ((1 + gamma) / 2 - e * slope) * dy + dy / y**2
        return (flow + slope / area * (gamma - 1) * y) / (e * area * y) - f(x, y, dy) / y

    def f_dy(x, y, dy):
        area, slope = 1 + x**2, 2 * x
        return (((1 + gamma) / 2 - e * slope) * y - 1 / y) / (e * area * y)

    return second_order(name, (0, 1), ends, f, f_y, f_dy, straight(*ends))


def multiple_solutions():
    bratu = [(name, c, 11, 0.0) for name, c in variants(34, (1.0, 3.0, 3.51))]
    bratu += [("E12a", 1.0, 5, 0.0), ("E12b", 1.0, 5, 3.0)]
    for name, c, nodes, start in bratu:
        yield second_order(
            name, (0, 1), (0, 0),
            lambda x, y, dy, c=c: -c * exp(y),
            lambda x, y, dy, c=c: -c * exp(y),
            zero,
            lambda x, start=start: (start, 0.0),
            nodes,
        )
    for name, start in (("E07a", 1.0), ("E07b", -1.0)):
        yield second_order(
            name, (0, 4), (0, -2),
            lambda x, y, dy: -np.abs(y),
            lambda x, y, dy: -np.sign(y),
            zero,
            lambda x, start=start: (start, 0.0),
        )
    x = np.linspace(0, 1, 11)
    yield Problem(
        "E29",
        lambda x, y: np.array([y[1], -20 * sin(y[0])]),
        lambda x, y: entries(2, x, {(0, 1): 1.0, (1, 0): -20 * cos(y[0])}),
        lambda ya, yb: np.array([ya[1], yb[1]]),
        x,
        guessed(x, 2 * cos(pi * x), -2 * pi * sin(pi * x)),
    )
