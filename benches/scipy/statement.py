"""What solve_bvp is given, and shorthands to state it."""

from dataclasses import dataclass
from typing import Callable

import numpy as np


@dataclass
class Problem:
    """The arguments of solve_bvp."""

    name: str
    fun: Callable
    fun_jac: Callable
    bc: Callable
    x: np.ndarray
    y: np.ndarray
    bc_jac: Callable | None = None
    p: np.ndarray | None = None
    S: np.ndarray | None = None


def guessed(x, *states):
    """States at the nodes x, numbers or arrays."""
    return np.array([np.broadcast_to(state, x.shape) for state in states], dtype=float)


def entries(n, x, values):
    """An n by n matrix at every x, zero but for the given elements."""
    jacobian = np.zeros((n, n, x.size))
    for (i, j), value in values.items():
        jacobian[i, j] = value
    return jacobian


def dirichlet(left, right):
    """y1 = left and y1 = right at the ends, and the Jacobians."""
    at_left, at_right = np.array([[1.0, 0.0], [0.0, 0.0]]), np.array([[0.0, 0.0], [1.0, 0.0]])
    bc = lambda ya, yb: np.array([ya[0] - left, yb[0] - right])
    return bc, lambda ya, yb: (at_left, at_right)


def second_order(name, interval, ends, f, f_y, f_dy, guess=None, nodes=11):
    """y'' = f(x, y, y') with y given at both ends, from zero or from guess(x)."""
    bc, bc_jac = dirichlet(*ends)
    x = np.linspace(*interval, nodes)
    return Problem(
        name,
        lambda x, y: np.array([y[1], f(x, y[0], y[1])]),
        lambda x, y: entries(
            2, x, {(0, 1): 1.0, (1, 0): f_y(x, y[0], y[1]), (1, 1): f_dy(x, y[0], y[1])}
        ),
        bc,
        x,
        guessed(x, *(guess(x) if guess else (0.0, 0.0))),
        bc_jac=bc_jac,
    )


def straight(left, right):
    """The line between two values at 0 and 1, and its slope."""
    return lambda x: (left + (right - left) * x, right - left)


def variants(number, values):
    """Names and values of the variants of a problem of the test set."""
    return [(f"T{number:02}{letter}", value) for letter, value in zip("abc", values)]


def zero(x, y, dy):
    """No dependence."""
    return 0.0
