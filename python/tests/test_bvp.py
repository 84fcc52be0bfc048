"""Boundary value problems with the calling convention of SciPy."""

import numpy as np
import pytest

from beltdrive import bvp


# y'' = y, y(0) = 1, y(1) = 0.
def sinh_fun(x, y):
    return np.vstack((y[1], y[0]))


def sinh_jac(x, y):
    jacobian = np.zeros((2, 2, x.size))
    jacobian[0, 1] = 1
    jacobian[1, 0] = 1
    return jacobian


def sinh_bc(ya, yb):
    return np.array([ya[0] - 1, yb[0]])


def sinh_bc_jac(ya, yb):
    return np.array([[1, 0], [0, 0]]), np.array([[0, 0], [1, 0]])


def sinh(x):
    return np.sinh(1 - x) / np.sinh(1)


# y'' = −k² y, y(0) = y(1) = 0, y'(0) = k.
def wave_fun(x, y, p):
    return np.vstack((y[1], -(p[0] ** 2) * y[0]))


def wave_jac(x, y, p):
    by_y, by_p = np.zeros((2, 2, x.size)), np.zeros((2, 1, x.size))
    by_y[0, 1] = 1
    by_y[1, 0] = -(p[0] ** 2)
    by_p[1, 0] = -2 * p[0] * y[0]
    return by_y, by_p


def wave_bc(ya, yb, p):
    return np.array([ya[0], yb[0], ya[1] - p[0]])


def wave_bc_jac(ya, yb, p):
    by_a, by_b, by_p = np.zeros((3, 2)), np.zeros((3, 2)), np.zeros((3, 1))
    by_a[0, 0] = by_b[1, 0] = by_a[2, 1] = 1
    by_p[2, 0] = -1
    return by_a, by_b, by_p


X = np.linspace(0, 1, 5)
ZERO = np.zeros((2, 5))
DENSE = np.linspace(0, 1, 101)


@pytest.mark.parametrize("jac", [None, sinh_jac])
@pytest.mark.parametrize("bc_jac", [None, sinh_bc_jac])
@pytest.mark.parametrize("tol", [1e-3, 1e-6, 1e-10])
def test_a_linear_problem(jac, bc_jac, tol) -> None:
    solution = bvp.solve(sinh_fun, sinh_bc, X, ZERO, fun_jac=jac, bc_jac=bc_jac, tol=tol)
    assert solution.success and solution.status == 0 and solution.p is None
    error = np.abs(solution.sol(DENSE)[0] - sinh(DENSE)).max()
    assert error <= tol and solution.error_estimate <= tol
    assert (solution.rms_residuals <= tol).all() and solution.rms_residuals.size == solution.x.size - 1
    assert solution.y.shape == solution.yp.shape == (2, solution.x.size)
    assert np.array_equal(solution.sol(solution.x), solution.y)
    assert np.array_equal(solution.sol(solution.x, 1), solution.yp)
    assert np.allclose(solution.yp, sinh_fun(solution.x, solution.y), atol=10 * tol)
    assert solution["x"] is solution.x and "error_y" in dir(solution)


@pytest.mark.parametrize("jac", [None, wave_jac])
@pytest.mark.parametrize("bc_jac", [None, wave_bc_jac])
def test_an_unknown_parameter(jac, bc_jac) -> None:
    x = np.linspace(0, 1, 5)
    y = np.zeros((2, 5))
    y[0, 1], y[0, 3] = 1, -1
    solution = bvp.solve(wave_fun, wave_bc, x, y, p=[6], fun_jac=jac, bc_jac=bc_jac, tol=1e-8)
    assert solution.success
    assert solution.p == pytest.approx([2 * np.pi], abs=1e-7)
    assert np.allclose(solution.sol(DENSE)[0], np.sin(2 * np.pi * DENSE), atol=1e-7)
    assert solution.error_p.shape == (1,) and solution.error_y.shape == (2,)
    assert solution.error_estimate == max(*solution.error_p, *solution.error_y)


@pytest.mark.parametrize("with_jac", [False, True])
def test_a_singular_term(with_jac) -> None:
    # Emden's equation y'' + 2 y'/x + y⁵ = 0 with y'(0) = 0 and y(1) = √(3/4), solved by 1 / √(1 + x²/3).
    def fun(x, y):
        return np.vstack((y[1], -(y[0] ** 5)))

    def jac(x, y):
        jacobian = np.zeros((2, 2, x.size))
        jacobian[0, 1] = 1
        jacobian[1, 0] = -5 * y[0] ** 4
        return jacobian

    def bc(ya, yb):
        return np.array([ya[1], yb[0] - np.sqrt(0.75)])

    y = np.array([np.full(5, np.sqrt(0.75)), np.full(5, 1e-4)])
    solution = bvp.solve(
        fun, bc, X, y, S=[[0, 0], [0, -2]], fun_jac=jac if with_jac else None, tol=1e-8
    )
    assert solution.success
    assert np.allclose(solution.sol(DENSE)[0], 1 / np.sqrt(1 + DENSE**2 / 3), atol=1e-8)


@pytest.mark.parametrize("with_jac", [False, True])
def test_complex_states(with_jac) -> None:
    # y' = i k y with an unknown k: y(0) = 1, y(1) = i, so that k = π/2 by the guess.
    def fun(x, y, p):
        return 1j * p[0] * y

    def jac(x, y, p):
        return np.full((1, 1, x.size), 1j * p[0]), (1j * y)[:, None, :]

    def bc(ya, yb, p):
        return np.array([ya[0] - 1, yb[0] - 1j])

    def bc_jac(ya, yb, p):
        return np.array([[1], [0]]), np.array([[0], [1]]), np.zeros((2, 1))

    jacobians = {"fun_jac": jac, "bc_jac": bc_jac} if with_jac else {}
    guess = np.exp(1.4j * X)[None]
    solution = bvp.solve(fun, bc, X, guess, p=[1.4], tol=1e-8, **jacobians)
    assert solution.success and solution.y.dtype == complex
    assert np.allclose(solution.p, [np.pi / 2], atol=1e-7)
    assert np.allclose(solution.sol(DENSE)[0], np.exp(0.5j * np.pi * DENSE), atol=1e-7)


def test_a_layer_gets_nodes() -> None:
    # ε y'' + x y' = −ε π² cos π x − π x sin π x, a shock of width √ε at 0 (SciPy's own example of this kind).
    epsilon = 1e-3

    def fun(x, y):
        force = -epsilon * np.pi**2 * np.cos(np.pi * x) - np.pi * x * np.sin(np.pi * x)
        return np.vstack((y[1], (force - x * y[1]) / epsilon))

    def bc(ya, yb):
        return np.array([ya[0] + 2, yb[0]])

    x = np.linspace(-1, 1, 5)
    both = bvp.solve(fun, bc, x, np.zeros((2, 5)), tol=1e-4)
    error = bvp.solve(fun, bc, x, np.zeros((2, 5)), tol=1e-4, control="error")
    assert both.success and error.success
    assert (both.rms_residuals <= 1e-4).all()
    assert both.error_estimate <= 1e-4 and error.error_estimate <= 1e-4
    steps = np.diff(both.x)
    assert steps.max() > 5 * steps.min()


def test_all_points_of_a_mesh_are_one_call() -> None:
    calls = []

    def fun(x, y):
        calls.append(x.size)
        return sinh_fun(x, y)

    x = np.linspace(0, 1, 100)
    solution = bvp.solve(fun, sinh_bc, x, np.zeros((2, 100)), fun_jac=sinh_jac, tol=1e-9)
    assert solution.success
    assert len(calls) < 20 and sum(calls) > 50 * len(calls)


def test_the_curve_takes_any_shape() -> None:
    curve = bvp.solve(sinh_fun, sinh_bc, X, ZERO).sol
    assert curve(0.3).shape == (2,) and curve([0.3]).shape == (2, 1)
    assert curve(np.full((3, 4), 0.3)).shape == (2, 3, 4)
    assert curve(0.3, 1)[0] == pytest.approx(curve(0.3)[1], abs=1e-3)
    # Outside the last polynomial goes on.
    assert curve(1.001)[0] == pytest.approx(curve(1.0)[0] + 0.001 * curve(1.0, 1)[0], abs=1e-5)
    with pytest.raises(ValueError, match="`nu`"):
        curve(0.3, 2)


def test_failures_are_told() -> None:
    def fun(x, y):
        return np.vstack((y[1], 1e4 * y[0]))

    few = bvp.solve(fun, sinh_bc, X, ZERO, tol=1e-9, max_nodes=6)
    assert (few.success, few.status) == (False, 1) and few.sol(0.5).shape == (2,)
    crowded = bvp.solve(fun, sinh_bc, X, ZERO, max_nodes=4)
    assert (crowded.success, crowded.status) == (False, 1) and "5 nodes" in crowded.message

    def undetermined(ya, yb):
        return np.array([ya[0], yb[0] - 1])

    singular = bvp.solve(lambda x, y: np.zeros_like(y), undetermined, X, ZERO)
    assert (singular.success, singular.status) == (False, 2) and "singular" in singular.message
    # y'' = −exp(y) has no solution with y = 0 at both ends for a factor above 3.51.
    bratu = bvp.solve(lambda x, y: np.vstack((y[1], -4 * np.exp(y[0]))), lambda a, b: np.array([a[0], b[0]]), X, ZERO)
    assert not bratu.success and bratu.status in (1, 3) and bratu.message


def test_exceptions_pass_through_and_end_the_work() -> None:
    calls = []

    def fun(x, y):
        calls.append(None)
        if len(calls) == 3:
            raise ZeroDivisionError("of the user")
        return sinh_fun(x, y)

    with pytest.raises(ZeroDivisionError, match="of the user"):
        bvp.solve(fun, sinh_bc, X, ZERO)
    assert len(calls) == 3

    shapes = iter([2, 2, 3, 3, 3])
    with pytest.raises(ValueError, match=r"`fun` returns an array of shape \(3, \d+\)"):
        bvp.solve(lambda x, y: np.zeros((next(shapes), x.size)), sinh_bc, X, ZERO)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"x": [0, 1, 0.5, 2, 3]}, "strictly increasing"),
        ({"x": [[0, 1]]}, "1 dimensional"),
        ({"x": [0]}, "two nodes"),
        ({"y": np.zeros((2, 4))}, "4 columns"),
        ({"y": np.zeros(5)}, "2 dimensional"),
        ({"y": np.full((2, 5), np.nan)}, "finite"),
        ({"p": [[1.0]]}, "`p` must be 1 dimensional"),
        ({"S": [[0, 0]]}, "`S` must have the shape"),
        ({"fun": lambda x, y: np.zeros(3)}, "`fun` returns an array of shape"),
        ({"fun": lambda x, y: 1j * y}, "complex"),
        ({"bc": lambda a, b: np.zeros(3)}, "`bc` returns an array of shape"),
        ({"fun_jac": lambda x, y: np.zeros((2, 2))}, "fun_jac"),
        ({"bc_jac": lambda a, b: (np.zeros((2, 2)),)}, "`bc_jac` returns 1 arrays"),
        ({"control": "residual"}, "`control`"),
        ({"tol": 1.0}, "tolerance"),
    ],
)
def test_statements_at_fault_are_refused(arguments, words) -> None:
    statement = {"fun": sinh_fun, "bc": sinh_bc, "x": X, "y": ZERO, **arguments}
    with pytest.raises(ValueError, match=words):
        bvp.solve(**statement)


def test_the_least_tolerance_and_what_is_printed(capsys) -> None:
    with pytest.warns(UserWarning, match="1e-13"):
        bvp.solve(sinh_fun, sinh_bc, X, ZERO, tol=1e-16)
    solution = bvp.solve_bvp(sinh_fun, sinh_bc, X, ZERO, verbose=1)
    assert capsys.readouterr().out.splitlines()[0].startswith("Solved in ")
    assert repr(solution).startswith("<Solution: The algorithm converged")
    tight = bvp.solve(sinh_fun, sinh_bc, X, ZERO, bc_tol=1e-9)
    assert tight.error_estimate <= 1e-9
