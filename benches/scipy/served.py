"""Solves problems whose right-hand sides another program evaluates, by scipy.integrate.solve_bvp.

Started by the survey of random problems of the package `reference-problems`, which see:

    cargo test -p reference-problems --release --test families -- --ignored beside_scipy

Both directions are lines of text, most of them followed by little-endian doubles. For every problem
this script reads "problem n k m tolerance", then m mesh nodes, n × m guessed states and k parameters.
While it solves, it asks

    rhs m             with m places, n × m states and k parameters, for n × m derivatives
    jacobian m        with the same, for n × n × m derivatives by states and n × k × m by parameters
    ends              with 2n end states and k parameters, for n + k residuals
    end-jacobian      with the same, for (n + k) × n by the left end, by the right end, then × k

and at last it says "solved m" or "refused m", with m nodes, n × m states, n × m slopes and k
parameters. The program answers every question with the numbers alone.
"""

import sys
import warnings

import numpy as np
from scipy.integrate import solve_bvp

INPUT, OUTPUT = sys.stdin.buffer, sys.stdout.buffer


def read(*shape):
    """An array from the other program."""
    size = int(np.prod(shape))
    return np.frombuffer(INPUT.read(8 * size), dtype="<f8").reshape(shape).copy()


def write(line, *arrays):
    """A line and arrays for the other program."""
    OUTPUT.write(line.encode() + b"\n")
    for array in arrays:
        OUTPUT.write(np.ascontiguousarray(array, dtype="<f8").tobytes())
    OUTPUT.flush()


def solve(n, k, nodes, tolerance):
    """Reads the rest of one problem and solves it."""
    x, y = read(nodes), read(n, nodes)
    p = read(k) if k else None
    given = lambda p: p if k else np.empty(0)

    def fun(x, y, p=None):
        write(f"rhs {x.size}", x, y, given(p))
        return read(n, x.size)

    def fun_jac(x, y, p=None):
        write(f"jacobian {x.size}", x, y, given(p))
        by_states = read(n, n, x.size)
        by_parameters = read(n, k, x.size)
        return (by_states, by_parameters) if k else by_states

    def bc(ya, yb, p=None):
        write("ends", ya, yb, given(p))
        return read(n + k)

    def bc_jac(ya, yb, p=None):
        write("end-jacobian", ya, yb, given(p))
        jacobians = read(n + k, n), read(n + k, n), read(n + k, k)
        return jacobians if k else jacobians[:2]

    try:
        result = solve_bvp(fun, bc, x, y, p=p, fun_jac=fun_jac, bc_jac=bc_jac, tol=tolerance)
    except (ValueError, FloatingPointError, np.linalg.LinAlgError):
        write("refused 0", given(p))
        return
    outcome = "solved" if result.status == 0 else "refused"
    write(f"{outcome} {result.x.size}", result.x, result.y, result.yp, given(result.p))


def main():
    """Solves problems until the other program ends."""
    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    for line in INPUT:
        _, n, k, nodes, tolerance = line.split()
        solve(int(n), int(k), int(nodes), float(tolerance))


main()
