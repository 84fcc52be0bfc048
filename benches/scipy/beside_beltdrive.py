"""Times beltdrive.bvp.solve beside scipy.integrate.solve_bvp on the reference problems, in one run.

    sh benches/scipy/beside_beltdrive.sh           all problems at 1e-3, 1e-6 and 1e-9, some minutes
    sh benches/scipy/beside_beltdrive.sh T01 E03   names that begin so

Both get the same functions of NumPy, guesses and meshes; see solve_bvp.py for what counts as solved. Prints a line for
each case and tolerance, and for each tolerance how many were solved, how many of the answers were false, and the median
of the ratios of the times where both were solved.
"""

import statistics
import sys
import warnings

import numpy as np
import scipy
from scipy.integrate import solve_bvp

import beltdrive.bvp
import solve_bvp as shared
from problems import all_problems

SOLVERS = {
    "scipy": solve_bvp,
    "beltdrive": beltdrive.bvp.solve,
    "beltdrive, error alone": lambda *given, **options: beltdrive.bvp.solve(*given, control="error", **options),
}


def outcome(solver, problem, tolerance, table):
    """Seconds, or none, and how it ended."""
    shared.solve_bvp = solver
    try:
        result, seconds = shared.measured(problem, tolerance)
    except (ValueError, FloatingPointError, np.linalg.LinAlgError):
        return None, "failed"
    if result.status != 0:
        return None, "failed"
    is_right = shared.true_error(result, table) <= shared.FALSE_FROM * tolerance
    return (seconds, "solved") if is_right else (None, "false")


def main(names):
    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    tables = shared.read_tables()
    print(f"# SciPy {scipy.__version__}, NumPy {np.__version__}; best of {shared.RUNS} runs, milliseconds")
    problems = [problem for problem in all_problems() if not names or problem.name.startswith(tuple(names))]
    for text in shared.TOLERANCES:
        found = {name: [] for name in SOLVERS}
        for problem in problems:
            for name, solver in SOLVERS.items():
                found[name].append(outcome(solver, problem, float(text), tables[problem.name]))
            cells = (f"{1e3 * seconds:.2f}" if seconds else how for seconds, how in (all_[-1] for all_ in found.values()))
            print(",".join([problem.name, text, *cells]), flush=True)
        for name, all_ in found.items():
            solved, false = (sum(how == word for _, how in all_) for word in ("solved", "false"))
            pairs = [(ours[0], theirs[0]) for ours, theirs in zip(all_, found["scipy"]) if ours[0] and theirs[0]]
            ratio = statistics.median(theirs / ours for ours, theirs in pairs) if pairs else float("nan")
            print(f"# {text} {name}: {solved} of {len(all_)} solved, {false} false; SciPy takes {ratio:.1f} times as long")


if __name__ == "__main__":
    main(sys.argv[1:])
