"""Boundary layers and channels."""

import numpy as np
from numpy import exp

from statement import Problem, entries, guessed, variants


def fluid_flow():
    x = np.linspace(0, 1, 11)
    for name, e in variants(32, (1e-2, 1e-3, 1e-4)):
        yield Problem(
            name,
            lambda x, y, e=e: np.array([y[1], y[2], y[3], (y[1] * y[2] - y[0] * y[3]) / e]),
            lambda x, y, e=e: entries(
                4, x,
                {
                    (0, 1): 1.0, (1, 2): 1.0, (2, 3): 1.0,
                    (3, 0): -y[3] / e, (3, 1): y[2] / e, (3, 2): y[1] / e, (3, 3): -y[0] / e,
                },
            ),
            lambda ya, yb: np.array([ya[0], ya[1], yb[0] - 1, yb[1]]),
            x,
            guessed(x, 3 * x**2 - 2 * x**3, 6 * x - 6 * x**2, 6 - 12 * x, -12.0),
        )
    x = np.linspace(0, 6, 11)
    yield Problem(
        "E04a",
        lambda x, y: np.array([y[1], y[2], -y[0] * y[2] - 0.5 * (1 - y[1] ** 2)]),
        lambda x, y: entries(
            3, x, {(0, 1): 1.0, (1, 2): 1.0, (2, 0): -y[2], (2, 1): y[1], (2, 2): -y[0]}
        ),
        lambda ya, yb: np.array([ya[0], ya[1], yb[1] - 1]),
        x,
        guessed(x, 0.0, 0.0, 1.0),
    )
    yield swirling_flow()
    yield channel_flow()


def swirling_flow():
    x = np.linspace(0, 11.3, 21)

    def fun(x, y):
        f, df, ddf, g, dg = y
        swirl = -1.55 * f * dg + 1.1 * df * g + 0.2 * (g - 1)
        return np.array([df, ddf, -1.55 * f * ddf + 0.1 * df**2 + 1 - g**2 + 0.2 * df, dg, swirl])

    def fun_jac(x, y):
        f, df, ddf, g, dg = y
        third = {(2, 0): -1.55 * ddf, (2, 1): 0.2 * df + 0.2, (2, 2): -1.55 * f, (2, 3): -2 * g}
        fifth = {(4, 0): -1.55 * dg, (4, 1): 1.1 * g, (4, 3): 1.1 * df + 0.2, (4, 4): -1.55 * f}
        return entries(5, x, {(0, 1): 1.0, (1, 2): 1.0, (3, 4): 1.0} | third | fifth)

    return Problem(
        "E10", fun, fun_jac,
        lambda ya, yb: np.array([ya[0], ya[1], ya[3], yb[1], yb[3] - 1]),
        x,
        exp(-x) * np.array([-(x**2), x**2 - 2 * x, -(x**2) + 4 * x - 2, exp(x) - 1, 1 + 0 * x]),
    )


def channel_flow():
    """Flow in a channel with injection; Reynolds number 100, Peclet number 70."""
    x = np.linspace(0, 1, 11)

    def fun(x, y, p):
        f, df, ddf, h, dh, t, dt = y
        third = 100 * (df**2 - f * ddf - p[0])
        return np.array([df, ddf, third, dh, -100 * f * dh - 1, dt, -70 * f * dt])

    def fun_jac(x, y, p):
        f, df, ddf, h, dh, t, dt = y
        third = {(2, 0): -100 * ddf, (2, 1): 200 * df, (2, 2): -100 * f}
        others = {(4, 0): -100 * dh, (4, 4): -100 * f, (6, 0): -70 * dt, (6, 6): -70 * f}
        ones = {(0, 1): 1.0, (1, 2): 1.0, (3, 4): 1.0, (5, 6): 1.0}
        of_p = np.zeros((7, 1, x.size))
        of_p[2, 0] = -100.0
        return entries(7, x, ones | third | others), of_p

    def bc(ya, yb, p):
        left = [ya[0], ya[1], ya[3], ya[5]]
        return np.array(left + [yb[0] - 1, yb[1], yb[3], yb[5] - 1])

    cubic = (3 * x**2 - 2 * x**3, 6 * x - 6 * x**2, 6 - 12 * x)
    y = guessed(x, *cubic, x * (1 - x) / 2, 1 / 2 - x, x, 1.0)
    return Problem("E16a", fun, fun_jac, bc, x, y, p=np.array([3.0]))
