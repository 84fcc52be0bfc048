"""Files of the program in the libraries of Python, where the program was built in the checkout."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

import beltdrive

pa = pytest.importorskip("pyarrow")
feather = pytest.importorskip("pyarrow.feather")
ipc = pytest.importorskip("pyarrow.ipc")
pq = pytest.importorskip("pyarrow.parquet")

TARGET = Path(__file__).parents[2] / "target"
BUILT = [path for profile in ("release", "debug") if (path := TARGET / profile / "beltdrive").is_file()]
PROGRAM = max(BUILT, key=lambda path: path.stat().st_mtime, default=None)

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="the program is not built")


def sweep(folder: Path, *options: str) -> None:
    (folder / "drive.toml").write_text(beltdrive.example("kim2009-flat"))
    subprocess.run([str(PROGRAM), "sweep", "drive.toml", "--quiet", *options], cwd=folder, check=True)


def test_arrow_and_parquet_hold_the_same_rows(tmp_path: Path) -> None:
    files = ("--arrow", "rows.arrow", "--parquet", "rows.parquet")
    sweep(tmp_path, "--over", "load.tight_tension=300 N:9 kN", "--sample", "sobol:50", "--chunk", "20", *files)
    with ipc.open_file(tmp_path / "rows.arrow") as file:
        assert file.num_record_batches == 3
        found = file.read_all()
    found.validate(full=True)
    expected = pq.read_table(tmp_path / "rows.parquet")
    assert found.replace_schema_metadata(None).equals(expected.replace_schema_metadata(None))
    assert found.schema.metadata == expected.schema.metadata
    assert found["row"].to_pylist() == list(range(50))
    assert {"answered", "no answer"} == set(found["status"].to_pylist())


def test_a_table_of_feather_gives_the_rows_of_solve_table(tmp_path: Path) -> None:
    friction = np.float32([1, 1, 1, 2])
    table = pa.table({"load.tight_tension [kN]": [0.5, None, 20.0, 0.75], "friction.coefficient": friction})
    for compression in ("lz4", "uncompressed"):
        feather.write_feather(table, tmp_path / "in.feather", compression=compression)
        sweep(tmp_path, "--table", "in.feather", "--arrow", "rows.arrow")
        found = feather.read_table(tmp_path / "rows.arrow").drop_columns("description")
        answers = pa.table(beltdrive.solve_table(beltdrive.example("kim2009-flat"), table))
        assert found.equals(answers.drop_columns("description").replace_schema_metadata(None))
