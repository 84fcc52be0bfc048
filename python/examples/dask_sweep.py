"""A sweep of many drives on the worker processes of a Dask cluster, in parts that may be solved any number of times.

    python dask_sweep.py --rows 1000000 --part 10000 --workers 2 --out sweep

The input is a folder of Parquet parts with an `id` for each row. A part is solved by one task: it returns at once if its
output stands, and otherwise writes a file under another name and renames it. So a task that is started again, started
twice or started after the machine was restarted does no harm, and the same command goes on where it was interrupted.
On a cluster, replace `LocalCluster` by the cluster of the site (dask-jobqueue has those of Slurm and PBS) and put
the folder where all workers see it.
"""

import argparse
import os
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from dask.distributed import Client, LocalCluster, as_completed

import beltdrive

#: What varies, and between which values.
RANGES = {
    "load.tight_tension [N]": (300.0, 3000.0),
    "friction.coefficient": (0.6, 1.4),
    "pulleys.driver.speed [rpm]": (600.0, 1800.0),
}


def write_inputs(folder: Path, rows: int, part: int) -> list[Path]:
    """The parts of a random sample. Each is the same whenever it is drawn, so that those which stand are left alone."""
    folder.mkdir(parents=True, exist_ok=True)
    sources = []
    for number, first in enumerate(range(0, rows, part)):
        source = folder / f"part-{number:06}.parquet"
        sources.append(source)
        if source.exists():
            continue
        count = min(part, rows - first)
        random = np.random.default_rng([rows, part, number])
        columns = {name: random.uniform(low, high, count) for name, (low, high) in RANGES.items()}
        write_whole(pa.table({"id": np.arange(first, first + count), **columns}), source)
    return sources


def write_whole(table: pa.Table, target: Path) -> None:
    """Writes a file that is there as a whole or not at all."""
    unfinished = target.with_name(f".{target.name}.{os.getpid()}.tmp")
    pq.write_table(table, unfinished)
    unfinished.replace(target)


def solve_part(source: Path, target: Path, drive: str) -> int:
    """Solves a part and returns how many rows were solved: none if its output stands."""
    if target.exists():
        return 0
    answers = beltdrive.solve_table(drive, pq.read_table(source), keep="id")
    write_whole(pa.table(answers), target)
    return len(answers)


def sweep(client: Client, drive: str, sources: list[Path], out: Path) -> int:
    """Solves all parts that have no output, and returns how many rows that took."""
    out.mkdir(parents=True, exist_ok=True)
    targets = [out / source.name for source in sources]
    tasks = client.map(solve_part, sources, targets, drive=drive, retries=3, pure=False)
    solved, start = 0, time.perf_counter()
    for done, (_, rows) in enumerate(as_completed(tasks, with_results=True), 1):
        solved += rows
        if done % max(1, len(tasks) // 10) == 0:
            print(f"{done} of {len(tasks)} parts, {solved / (time.perf_counter() - start):.0f} rows/s", flush=True)
    return solved


def check(sources: list[Path], out: Path, rows: int) -> None:
    """Whether every row is there once."""
    ids = np.concatenate([pq.read_table(out / source.name, columns=["id"])["id"].to_numpy() for source in sources])
    assert ids.size == rows, f"{ids.size} rows of {rows}"
    assert np.array_equal(np.sort(ids), np.arange(rows)), "a row is missing or there twice"
    print(f"all {rows} rows are there once")


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--drive", help="a drive file [default: the example kim2009-flat]")
    options.add_argument("--rows", type=int, default=100_000)
    options.add_argument("--part", type=int, default=10_000, help="rows of a part")
    options.add_argument("--workers", type=int, default=2)
    options.add_argument("--out", type=Path, default=Path("sweep"))
    options.add_argument("--plain", action="store_true", help="solve in this process with as many threads instead")
    options.add_argument("--kill", type=float, metavar="SECONDS", help="kill a worker after so long")
    given = options.parse_args()
    drive = Path(given.drive).read_text() if given.drive else beltdrive.example("kim2009-flat")
    sources = write_inputs(given.out / "in", given.rows, given.part)
    out = given.out / "out"
    if given.plain:
        # Before the first drive is solved.
        os.environ["RAYON_NUM_THREADS"] = str(given.workers)
        out.mkdir(parents=True, exist_ok=True)
        start = time.perf_counter()
        solved = sum(solve_part(source, out / source.name, drive) for source in sources)
    else:
        # A worker is one process that solves one part at a time on one thread.
        environment = {"RAYON_NUM_THREADS": "1"}
        with (
            LocalCluster(
                n_workers=given.workers, threads_per_worker=1, env=environment, dashboard_address=None
            ) as cluster,
            Client(cluster) as client,
        ):
            # Workers that have loaded the package.
            pids = client.run(lambda: beltdrive.__name__ and os.getpid())
            if given.kill:
                victim = next(iter(pids.values()))
                threading.Timer(given.kill, os.kill, [victim, signal.SIGKILL]).start()
            start = time.perf_counter()
            solved = sweep(client, drive, sources, out)
    seconds = time.perf_counter() - start
    print(f"{solved} rows in {seconds:.2f} s, {solved / seconds:.0f} rows/s")
    check(sources, out, given.rows)


if __name__ == "__main__":
    main()
