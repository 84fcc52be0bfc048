"""Times scipy.integrate.solve_bvp on the reference problems; see run.sh.

The best of five runs in processor time, which other programs do not lengthen, with analytic
Jacobians, from the same guesses on the same meshes as the cases of the Rust crate
`reference-problems`. Prints comma-separated values, one line per case and
tolerance. A solution counts if SciPy reports success and its error at the points of the reference
table is at most ten times the tolerance; for the others the column of the time is empty.
"""

import math
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import scipy
from scipy.integrate import solve_bvp

from problems import all_problems

TOLERANCES = ("1e-3", "1e-6", "1e-9")
RUNS = 5
MAX_NODES = 30_000
FALSE_FROM = 10.0
TABLES = Path(__file__).parents[2] / "tests" / "src" / "reference_solutions.txt"


def read_tables():
    """Reference solutions by case: a list of (x, states) and the parameters."""
    tables = {}
    for line in TABLES.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if not words or words[0].startswith("#"):
            continue
        if words[0] == "case":
            points, parameters = tables.setdefault(words[1], ([], []))
        elif words[0] == "parameters":
            parameters.extend(map(float, words[1:]))
        else:
            points.append((float(words[1]), np.array(words[2:], dtype=float)))
    return tables


def true_error(result, table):
    """max |y - yref| / (1 + |yref|) over the points of the table and the parameters."""
    points, parameters = table
    pairs = [(result.sol(x), y) for x, y in points]
    if parameters:
        pairs.append((result.p, np.array(parameters)))
    return max(np.max(np.abs(y - yref) / (1 + np.abs(yref))) for y, yref in pairs)


def solve(problem, tolerance):
    """One solution from the guess of the problem."""
    return solve_bvp(
        problem.fun,
        problem.bc,
        problem.x,
        problem.y,
        p=problem.p,
        S=problem.S,
        fun_jac=problem.fun_jac,
        bc_jac=problem.bc_jac,
        tol=tolerance,
        max_nodes=MAX_NODES,
    )


def measured(problem, tolerance):
    """A result and the least seconds of its runs; a failure is not repeated."""
    least, runs = math.inf, RUNS
    while runs > 0:
        start = time.process_time()
        result = solve(problem, tolerance)
        seconds = time.process_time() - start
        least = min(least, seconds)
        runs = 0 if result.status != 0 else runs - 1
    return result, least


def main(names):
    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    tables = read_tables()
    print(f"# solve_bvp of SciPy {scipy.__version__}, NumPy {np.__version__}; best of {RUNS} runs")
    print("case,tolerance,microseconds,nodes,true_error,status")
    for problem in all_problems():
        if names and not problem.name.startswith(tuple(names)):
            continue
        for text in TOLERANCES:
            tolerance = float(text)
            try:
                result, seconds = measured(problem, tolerance)
            except (ValueError, FloatingPointError, np.linalg.LinAlgError) as error:
                print(f"{problem.name},{text},,,,{type(error).__name__}", flush=True)
                continue
            error = true_error(result, tables[problem.name])
            right = result.status == 0 and error <= FALSE_FROM * tolerance
            microseconds = f"{1e6 * seconds:.1f}" if right else ""
            status = "solved" if right else ("false" if result.status == 0 else "failed")
            line = f"{problem.name},{text},{microseconds},{result.x.size},{error:.1e},{status}"
            print(line, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
