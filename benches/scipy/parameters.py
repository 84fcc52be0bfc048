"""Problems with unknown parameters."""

import numpy as np
from numpy import cos, pi, sin

from statement import Problem, entries, guessed


def with_parameters(name, fun, jacobian, bc, x, y, p):
    """A problem whose jacobian(x, y, p) gives the elements by state and those by parameter."""
    n, k = len(y), len(p)

    def fun_jac(x, y, p):
        by_state, by_parameter = jacobian(x, y, p)
        of_p = np.zeros((n, k, x.size))
        for (i, j), value in by_parameter.items():
            of_p[i, j] = value
        return entries(n, x, by_state), of_p

    return Problem(name, fun, fun_jac, bc, x, y, p=np.array(p, dtype=float))


def eigenvalues():
    x = np.linspace(0, pi, 11)
    yield with_parameters(
        "E01",
        lambda x, y, p: np.array([y[1], -(p[0] - 10 * cos(2 * x)) * y[0]]),
        lambda x, y, p: (
            {(0, 1): 1.0, (1, 0): -(p[0] - 10 * cos(2 * x))}, {(1, 0): -y[0]}
        ),
        lambda ya, yb, p: np.array([ya[1], yb[1], ya[0] - 1]),
        x, guessed(x, cos(4 * x), -4 * sin(4 * x)), [15.0],
    )
    x = np.linspace(0, 1, 11)
    yield with_parameters(
        "E11b",
        lambda x, y, p: np.array([y[1], -p[0] ** 2 * y[0]]),
        lambda x, y, p: ({(0, 1): 1.0, (1, 0): -p[0] ** 2}, {(1, 0): -2 * p[0] * y[0]}),
        lambda ya, yb, p: np.array([ya[0], yb[0], ya[1] - p[0]]),
        x, guessed(x, sin(3 * x), 3 * cos(3 * x)), [3.0],
    )
    x = np.linspace(0, 0.5, 11)
    yield with_parameters(
        "E18",
        lambda x, y, p: np.array([cos(y[2]), sin(y[2]), y[3], p[0] * cos(y[2])]),
        lambda x, y, p: (
            {(0, 2): -sin(y[2]), (1, 2): cos(y[2]), (2, 3): 1.0, (3, 2): -p[0] * sin(y[2])},
            {(3, 0): cos(y[2])},
        ),
        lambda ya, yb, p: np.array([ya[0], ya[1], ya[3], yb[1], yb[2] + pi / 2]),
        x, guessed(x, x, 0.0, 0.0, 0.0), [0.0],
    )
    x = np.linspace(0, 1, 11)
    yield with_parameters(
        "E31",
        lambda x, y, p: np.array([p[1] * y[1], -p[1] * y[2], -p[1] * p[0] + 0 * x]),
        lambda x, y, p: (
            {(0, 1): p[1], (1, 2): -p[1]},
            {(0, 1): y[1], (1, 1): -y[2], (2, 0): -p[1], (2, 1): -p[0]},
        ),
        lambda ya, yb, p: np.array(
            [ya[0], ya[1], yb[0] - 1, yb[1], 1 - yb[2] ** 2 / 2 + p[0] * yb[1]]
        ),
        x, guessed(x, x, 1.0, 2 * x - 1), [-1.0, 2.0],
    )


def periodic():
    x = np.linspace(-pi / 2, pi / 2, 21)
    yield with_parameters(
        "E14",
        lambda x, y, p: 10 * np.array([sin(x) ** 2 - p[0] * sin(x) ** 4 / y[0]]),
        lambda x, y, p: (
            {(0, 0): 10 * p[0] * sin(x) ** 4 / y[0] ** 2}, {(0, 0): -10 * sin(x) ** 4 / y[0]}
        ),
        lambda ya, yb, p: np.array([ya[0] - 1, yb[0] - 1]),
        x, guessed(x, 0.5), [1.0],
    )
    x = np.linspace(0, 1, 21)

    def slopes(v, w):
        return 3 * (v + w - v**3 / 3 - 1.3), -(v - 0.7 + 0.8 * w) / 3

    def phase(ya, p):
        return p[0] * slopes(*ya)[1] - 1

    yield with_parameters(
        "E15",
        lambda x, y, p: p[0] * np.array(slopes(*y)),
        lambda x, y, p: (
            {
                (0, 0): 3 * p[0] * (1 - y[0] ** 2), (0, 1): 3 * p[0],
                (1, 0): -p[0] / 3, (1, 1): -0.8 * p[0] / 3,
            },
            {(0, 0): slopes(*y)[0], (1, 0): slopes(*y)[1]},
        ),
        lambda ya, yb, p: np.array([ya[0] - yb[0], ya[1] - yb[1], phase(ya, p)]),
        x, guessed(x, 2 * sin(2 * pi * x), cos(2 * pi * x)), [2 * pi],
    )
