"""The worked example of a sweep on a cluster."""

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("dask.distributed")
pq = pytest.importorskip("pyarrow.parquet")

EXAMPLE = Path(__file__).parents[1] / "examples" / "dask_sweep.py"


def run(folder: Path, *options: str) -> str:
    command = [sys.executable, str(EXAMPLE), "--part", "1000", "--workers", "2", "--out", str(folder), *options]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_killed_worker_loses_no_row_and_finished_parts_stand(tmp_path: Path) -> None:
    told = run(tmp_path, "--rows", "40000", "--kill", "0.3")
    assert "all 40000 rows are there once" in told
    out = tmp_path / "out"
    before = {part.name: part.stat().st_mtime_ns for part in out.glob("part-*.parquet")}
    assert len(before) == 40
    # What is lost is solved again, and nothing else.
    (out / "part-000007.parquet").unlink()
    table = pq.read_table(out / "part-000008.parquet")
    assert table["status"].to_pylist().count("answered") > 800
    told = run(tmp_path, "--rows", "40000", "--plain")
    assert told.startswith("1000 rows in ") and "all 40000 rows are there once" in told
    after = {part.name: part.stat().st_mtime_ns for part in out.glob("part-*.parquet")}
    changed = [name for name in after if after[name] != before[name]]
    assert changed == ["part-000007.parquet"]
