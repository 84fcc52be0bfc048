"""A singular coefficient, a jump, strongly nonlinear conditions, thirty equations."""

import numpy as np
from numpy import pi, sin, sinh, sqrt

from statement import Problem, dirichlet, entries, guessed


def special_conditions():
    x = np.linspace(0, 1, 11)
    yield Problem(
        "E03",
        lambda x, y: np.array([y[1], -y[0] ** 5]),
        lambda x, y: entries(2, x, {(0, 1): 1.0, (1, 0): -5 * y[0] ** 4}),
        lambda ya, yb: np.array([ya[1], yb[0] - sqrt(3) / 2]),
        x,
        guessed(x, sqrt(3) / 2, 1e-4),
        S=np.array([[0.0, 0.0], [0.0, -2.0]]),
    )
    bc, bc_jac = dirichlet(0, 0)
    yield Problem(
        "E28",
        lambda x, y: np.array([y[1], np.where(x > 1 / 3, -1.0, 0.0)]),
        lambda x, y: entries(2, x, {(0, 1): 1.0}),
        bc,
        x,
        guessed(x, 0.0, 0.0),
        bc_jac=bc_jac,
    )
    x = np.linspace(0, 0.1, 11)
    yield Problem(
        "E11c",
        lambda x, y: np.array([y[1], 0 * x]),
        lambda x, y: entries(2, x, {(0, 1): 1.0}),
        lambda ya, yb: np.array(
            [
                0.02 * sinh(38.9 * -ya[0]) + 1.64 * ya[1],
                2e-4 * sinh(38.9 * (-0.5 - yb[0])) - 1.64 * yb[1],
            ]
        ),
        x,
        guessed(x, 0.0, 0.0),
    )


def systems():
    """Fifteen rods side by side: y1, y3, ... are values and y2, y4, ... their slopes."""
    count = 15
    x, ends = np.linspace(0, 1, 11), sin(pi * np.arange(1, count + 1) / (count + 1))
    laplacian = 2 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1)

    def fun(x, y):
        slopes = np.empty_like(y)
        slopes[0::2] = y[1::2]
        slopes[1::2] = 16 * (laplacian @ y[0::2]) + y[0::2] ** 3
        return slopes

    def fun_jac(x, y):
        jacobian = np.zeros((2 * count, 2 * count, x.size))
        for i in range(count):
            jacobian[2 * i, 2 * i + 1] = 1.0
            jacobian[2 * i + 1, 0::2] = 16 * laplacian[i][:, None]
            jacobian[2 * i + 1, 2 * i] += 3 * y[2 * i] ** 2
        return jacobian

    yield Problem(
        "E25",
        fun,
        fun_jac,
        lambda ya, yb: np.concatenate([ya[0::2] - ends, yb[0::2]]),
        x,
        np.zeros((2 * count, x.size)),
    )
