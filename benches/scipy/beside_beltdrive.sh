#!/bin/sh
# Runs beside_beltdrive.py with a released wheel of the folder `python`, in the virtual environment of run.sh.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
environment=${SCIPY_ENV:-$here/../../target/scipy}
if ! [ -x "$environment/bin/python" ]; then
    python3 -m venv "$environment"
fi
"$environment/bin/python" -m pip install --quiet --requirement "$here/requirements.txt" "$here/../../python" >&2
# One thread each.
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 PYTHONDONTWRITEBYTECODE=1
exec "$environment/bin/python" "$here/beside_beltdrive.py" "$@"
