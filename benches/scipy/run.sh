#!/bin/sh
# Times SciPy's solve_bvp on the reference problems and prints comma-separated values:
#
#     sh benches/scipy/run.sh >times.csv           all problems at 1e-3, 1e-6 and 1e-9, some minutes
#     sh benches/scipy/run.sh T01 E03 >times.csv   names that begin so
#     cargo bench -p benches --bench reference_set -- --scipy times.csv
#
# Needs Python 3.10 or newer and, the first time, access to PyPI. The virtual environment is made in
# $SCIPY_ENV or target/scipy.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
environment=${SCIPY_ENV:-$here/../../target/scipy}
if ! [ -x "$environment/bin/python" ]; then
    python3 -m venv "$environment"
fi
"$environment/bin/python" -m pip install --quiet --requirement "$here/requirements.txt" >&2
# One thread, as the other codes.
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 PYTHONDONTWRITEBYTECODE=1
exec "$environment/bin/python" "$here/solve_bvp.py" "$@"
