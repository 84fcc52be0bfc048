"""Boundary value problems of ordinary differential equations.

:func:`solve` has the calling convention of ``scipy.integrate.solve_bvp``; it is called :func:`solve_bvp` as well. The
method is another one: collocation at Gauss points, of order 4 to 14 by the tolerance, with an estimate of the error of
the solution.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any, Literal, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _native

__all__ = ["Curve", "Solution", "solve", "solve_bvp"]

#: The least tolerance: some hundred times the rounding unit.
_LEAST = 1e-13


class Curve:
    """The continuous solution: ``curve(x)`` has the shape of y at one place, ``(n,)``, and that of ``x`` behind it.

    ``curve(x, 1)`` is its derivative. Outside the mesh the first and the last polynomial are extended.
    """

    def __init__(self, told: _native.BvpSolution, is_complex: bool) -> None:
        self._told, self._is_complex = told, is_complex
        #: The nodes of the mesh, between which it is a polynomial each.
        self.x: np.ndarray = np.array(told.mesh())

    def __call__(self, x: ArrayLike, nu: Literal[0, 1] = 0) -> np.ndarray:
        places = np.asarray(x, dtype=float)
        if nu not in (0, 1):
            raise ValueError("`nu` is 0 for the solution or 1 for its derivative")
        values = self._told.slopes if nu else self._told.values
        table = np.array(values(places.tobytes()))
        if self._is_complex:
            half = table.shape[0] // 2
            table = table[:half] + 1j * table[half:]
        return table.reshape(table.shape[0], *places.shape)


class Solution(dict[str, Any]):
    """What :func:`solve` found, as items and attributes.

    ``sol``
        The continuous solution, a :class:`Curve`.
    ``p``
        The parameters, or ``None`` without any.
    ``x``, ``y``, ``yp``
        The nodes of the mesh (m,), the solution there (n, m) and its derivatives.
    ``success``, ``status``, ``message``
        Whether the solution was found: 0; too many nodes: 1; a singular Jacobian: 2; anything else: 3; in words.
    ``rms_residuals``
        The root mean square of the relative residual of the differential equations over each interval (m - 1,).
    ``error_estimate``
        The estimated error of the solution, the largest of all states and parameters, relative to 1 + |value|; ``None``
        where it could not be estimated.
    ``error_y``, ``error_p``
        The same for each state (n,), the largest on the mesh, and for each parameter (k,).
    ``niter``, ``stats``
        The number of meshes, and what was done on them.
    """

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(name) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    def summary(self) -> str:
        """How it ended, on a few lines."""
        if self["success"]:
            ended = f"Solved in {self['niter']} meshes, number of nodes {self['x'].size}."
        else:
            ended = f"{self['message']} Meshes {self['niter']}, number of nodes {self['x'].size}."
        error = self["error_estimate"]
        estimate = "unknown" if error is None else f"{error:.2e}"
        return f"{ended}\nMaximum relative residual: {self['rms_residuals'].max():.2e}\nEstimated error: {estimate}"

    def __repr__(self) -> str:
        error = self["error_estimate"]
        estimate = "no error estimate" if error is None else f"estimated error {error:.1e}"
        return f"<Solution: {self['message']} {self['x'].size} nodes, {estimate}>"


def solve(
    fun: Callable[..., ArrayLike],
    bc: Callable[..., ArrayLike],
    x: ArrayLike,
    y: ArrayLike,
    p: Optional[ArrayLike] = None,
    S: Optional[ArrayLike] = None,
    fun_jac: Optional[Callable[..., Any]] = None,
    bc_jac: Optional[Callable[..., Any]] = None,
    tol: float = 1e-3,
    max_nodes: int = 1000,
    verbose: Literal[0, 1, 2] = 0,
    bc_tol: Optional[float] = None,
    *,
    control: Literal["both", "error"] = "both",
) -> Solution:
    """Solve a boundary value problem of first-order differential equations with unknown parameters.

        dy/dx = f(x, y, p) + S y / (x - a),  a <= x <= b,    bc(y(a), y(b), p) = 0

    Parameters
    ----------
    fun
        ``fun(x, y)``, or ``fun(x, y, p)`` with parameters: f at m places, (n, m), from x (m,), y (n, m), p (k,). Places are
        all those of a mesh.
    bc
        ``bc(ya, yb)``, or ``bc(ya, yb, p)``: n + k numbers, which are zero at the solution.
    x, y, p
        A first mesh (m,) from a to b, a guess of the solution there (n, m), real or complex, and one of the parameters.
    S
        The singular term (n, n), or None.
    fun_jac
        ``fun_jac(x, y)`` returns ∂f/∂y (n, n, m), ``fun_jac(x, y, p)`` that and ∂f/∂p (n, k, m), without the singular
        term. By default they are central differences.
    bc_jac
        ``bc_jac(ya, yb)`` returns ∂bc/∂ya and ∂bc/∂yb (n + k, n), ``bc_jac(ya, yb, p)`` those and ∂bc/∂p (n + k, k). By
        default they are central differences.
    tol
        The largest relative residual of the differential equations, and the largest error of the solution relative to
        1 + |y|, which is estimated; 1e-13 to 0.1.
    max_nodes
        The largest number of nodes.
    verbose
        1 or 2 print :meth:`Solution.summary`.
    bc_tol
        The largest residual of the conditions, where it is less than `tol`: then it stands in the place of that.
    control
        ``"error"`` bounds the error alone, which takes fewer nodes on most problems. (SciPy bounds the residual alone.)

    Raises
    ------
    ValueError
        Arrays have wrong shapes, or a number is not finite or out of range. Exceptions of the functions pass through.
    """
    statement = _Statement(fun, bc, x, y, p, S, fun_jac, bc_jac)
    if control not in ("error", "both"):
        raise ValueError('`control` is "both" or "error"')
    tolerance = float(tol) if bc_tol is None else min(float(tol), float(bc_tol))
    if tolerance < _LEAST:
        warnings.warn(f"`tol` is raised to {_LEAST}, the least there is", stacklevel=2)
        tolerance = _LEAST
    if max_nodes < statement.x.size:
        return statement.no_room(max_nodes)
    told = _native.solve_bvp(
        statement.fun_bytes,
        statement.fun_jac_bytes if fun_jac is not None else None,
        statement.bc_bytes,
        statement.bc_jac_bytes if bc_jac is not None else None,
        statement.x.tobytes(),
        statement.real(statement.y).T.tobytes(),
        statement.real(statement.p).tobytes(),
        tolerance,
        max_nodes,
        control == "both",
    )
    solution = statement.solution(told)
    if verbose:
        print(solution.summary())
    return solution


#: The name of the function of SciPy.
solve_bvp = solve


class _Statement:
    """A problem with its functions, as they are stated and as the solver calls them."""

    def __init__(self, fun: Any, bc: Any, x: Any, y: Any, p: Any, S: Any, fun_jac: Any, bc_jac: Any) -> None:
        self.x = np.asarray(x, dtype=float)
        if self.x.ndim != 1 or self.x.size < 2:
            raise ValueError("`x` must be 1 dimensional with at least two nodes")
        if not (np.diff(self.x) > 0).all():
            raise ValueError("`x` must be strictly increasing")
        self.is_complex = np.iscomplexobj(y)
        self.y = np.asarray(y, dtype=complex if self.is_complex else float)
        if self.y.ndim != 2 or self.y.shape[0] == 0:
            raise ValueError("`y` must be 2 dimensional")
        if self.y.shape[1] != self.x.size:
            raise ValueError(f"`y` has {self.y.shape[1]} columns and `x` {self.x.size} nodes")
        if not np.isfinite(self.y).all():
            raise ValueError("`y` must be finite")
        self.p = np.array([] if p is None else p, dtype=self.y.dtype)
        if self.p.ndim != 1:
            raise ValueError("`p` must be 1 dimensional")
        self.n, self.k = self.y.shape[0], self.p.size
        self.S = None if S is None else np.asarray(S, dtype=float)
        if self.S is not None and self.S.shape != (self.n, self.n):
            raise ValueError(f"`S` must have the shape {(self.n, self.n)}, not {self.S.shape}")
        self.fun, self.bc, self.fun_jac, self.bc_jac = fun, bc, fun_jac, bc_jac
        # Shapes that are wrong say so at once.
        self._fun(self.x, self.y, self.p)
        self._bc(self.y[:, 0], self.y[:, -1], self.p)
        if fun_jac is not None:
            self._fun_jac(self.x, self.y, self.p)
        if bc_jac is not None:
            self._bc_jac(self.y[:, 0], self.y[:, -1], self.p)

    # The functions as they are stated.

    def _arguments(self, p: np.ndarray) -> tuple[np.ndarray, ...]:
        return (p,) if self.k else ()

    def _fun(self, x: np.ndarray, y: np.ndarray, p: np.ndarray) -> np.ndarray:
        return self._shaped("fun", self.fun(x, y, *self._arguments(p)), y.shape)

    def _bc(self, ya: np.ndarray, yb: np.ndarray, p: np.ndarray) -> np.ndarray:
        return self._shaped("bc", self.bc(ya, yb, *self._arguments(p)), (self.n + self.k,))

    def _fun_jac(self, x: np.ndarray, y: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        found = self.fun_jac(x, y, *self._arguments(p))
        by_y, by_p = found if self.k else (found, np.zeros((self.n, 0, x.size)))
        by_y = self._shaped("∂f/∂y of fun_jac", by_y, (self.n, self.n, x.size))
        return by_y, self._shaped("∂f/∂p of fun_jac", by_p, (self.n, self.k, x.size))

    def _bc_jac(self, ya: np.ndarray, yb: np.ndarray, p: np.ndarray) -> list[np.ndarray]:
        found = self.bc_jac(ya, yb, *self._arguments(p))
        widths = [self.n, self.n, self.k][: 2 + bool(self.k)]
        if len(found) != len(widths):
            raise ValueError(f"`bc_jac` returns {len(found)} arrays, not {len(widths)}")
        rows = self.n + self.k
        return [self._shaped("a derivative of bc_jac", part, (rows, width)) for part, width in zip(found, widths)]

    def _shaped(self, name: str, values: Any, shape: tuple[int, ...]) -> np.ndarray:
        values = np.asarray(values)
        if values.shape != shape:
            raise ValueError(f"`{name}` returns an array of shape {values.shape}, not {shape}")
        if self.is_complex:
            return values.astype(complex, copy=False)
        if np.iscomplexobj(values):
            raise ValueError(f"`{name}` returns complex numbers, and `y` is real")
        return values.astype(float, copy=False)

    # The same as the solver calls them: complex numbers are their real and then their imaginary parts.

    def real(self, values: np.ndarray) -> np.ndarray:
        """Rows as real numbers."""
        return np.concatenate([values.real, values.imag]) if self.is_complex else values

    def own(self, values: Any) -> np.ndarray:
        """Rows as they are stated."""
        values = np.asarray(values)
        half = values.shape[0] // 2
        return values[:half] + 1j * values[half:] if self.is_complex else values

    def _real_matrix(self, *blocks: np.ndarray) -> bytes:
        """The derivatives with respect to complex numbers as those of and with respect to real ones."""
        if self.is_complex:
            above = [part for block in blocks for part in (block.real, -block.imag)]
            below = [part for block in blocks for part in (block.imag, block.real)]
            return np.concatenate([np.concatenate(above, axis=1), np.concatenate(below, axis=1)]).tobytes()
        return np.concatenate(blocks, axis=1).tobytes()

    def fun_bytes(self, x: Any, y: Any, p: Any) -> bytes:
        places, states = np.asarray(x), self.own(y)
        values = self._fun(places, states, self.own(p))
        if self.S is not None:
            values = values + self.S @ states / (places - self.x[0])
        return self.real(values).tobytes()

    def fun_jac_bytes(self, x: Any, y: Any, p: Any) -> bytes:
        places = np.asarray(x)
        by_y, by_p = self._fun_jac(places, self.own(y), self.own(p))
        if self.S is not None:
            by_y = by_y + self.S[:, :, None] / (places - self.x[0])
        return self._real_matrix(by_y, by_p)

    def bc_bytes(self, ya: Any, yb: Any, p: Any) -> bytes:
        return self.real(self._bc(self.own(ya), self.own(yb), self.own(p))).tobytes()

    def bc_jac_bytes(self, ya: Any, yb: Any, p: Any) -> bytes:
        return self._real_matrix(*self._bc_jac(self.own(ya), self.own(yb), self.own(p)))

    # What was found.

    def solution(self, told: _native.BvpSolution) -> Solution:
        curve = Curve(told, self.is_complex)
        errors = [told.state_errors(), told.parameter_errors()]
        error_y, error_p = (None if error is None else np.abs(self.own(error)) for error in errors)
        return Solution(
            sol=curve,
            p=self.own(told.parameters()) if self.k else None,
            x=curve.x,
            y=curve(curve.x),
            yp=curve(curve.x, 1),
            rms_residuals=np.array(told.defects()),
            niter=told.stats()["meshes"],
            status=told.status,
            message=told.message,
            success=told.status == 0,
            error_estimate=told.error_estimate(),
            error_y=error_y,
            error_p=error_p if self.k else None,
            stats=told.stats(),
        )

    def no_room(self, max_nodes: int) -> Solution:
        """The guess, which has more nodes than are allowed."""
        return Solution(
            sol=None,
            p=self.p if self.k else None,
            x=self.x,
            y=self.y,
            yp=self._fun(self.x, self.y, self.p),
            rms_residuals=np.full(self.x.size - 1, np.inf),
            niter=0,
            status=1,
            message=f"The guess has {self.x.size} nodes, and {max_nodes} are allowed.",
            success=False,
            error_estimate=None,
            error_y=None,
            error_p=None,
            stats={},
        )
