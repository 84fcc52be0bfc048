"""Errors and processor times of load_step.py and of `beltdrive simulate load-step.toml` against 960 cells of the latter.

    python compare.py BELTDRIVE

Root mean squares over the samples of the last 45 ms, which begin 5 ms after the step of the load.
"""

import csv
import os
import resource
import subprocess
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
FROM = 0.105
# Cells of the mesh, and elements, step in s and stiffness of the contact in N/m per length.
MESHES = [15, 30, 60, 120, 240, 480]
ELEMENTS = [(60, 2e-5, 2e9), (120, 2e-5, 2e9), (120, 2e-5, 1e10)]
# A run is begun so often, for times as short as that of the program itself.
REPEATED = 5


def timed(command):
    """The output of a command and its processor time in s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def beltdrive(program, cells):
    """Samples and the shortest processor time of some runs, s."""
    file = os.path.join(HERE, "load-step.toml")
    command = [program, "simulate", file, "--set", f"transient.cells={cells}", "--units", "si", "--csv", "-"]
    runs = [timed(command) for _ in range(REPEATED)]
    rows = list(csv.DictReader(runs[0][0].stdout.splitlines()))
    samples = np.array([[float(row[name]) for name in NAMES] for row in rows])
    return samples, min(seconds for _, seconds in runs)


def exudyn(elements, step, contact):
    """Samples and processor time of the solver alone, s."""
    command = [sys.executable, os.path.join(HERE, "load_step.py"), str(elements), str(step), str(contact)]
    done, _ = timed(command)
    lines = done.stdout.splitlines()
    lines = lines[lines.index("time,speed,tight,slack") + 1 :]
    samples = np.array([[float(number) for number in line.split(",")] for line in lines if line[:1].isdigit()])
    # Warnings of the module may stand before.
    return samples, float(done.stderr.splitlines()[-1].split()[0])


# Columns of the samples: time, speed of the driven pulley, tensions of the tight and of the slack span.
NAMES = [
    "time_s",
    "driven_angular_speed_rad_per_s",
    "driven_to_driver_tension_N",
    "driver_to_driven_tension_N",
]


def errors(samples, reference):
    """Root mean squares of the errors of speed, tight and slack tension in the last part of the run."""
    late = reference[:, 0] > FROM
    found = [np.interp(reference[late, 0], samples[:, 0], samples[:, column]) for column in [1, 2, 3]]
    return [np.sqrt(np.mean((one - reference[late, 1 + index]) ** 2)) for index, one in enumerate(found)]


def main():
    program = sys.argv[1]
    reference, _ = beltdrive(program, 960)
    print("| | speed, rad/s | tight, N | slack, N | processor time, s |")
    print("| --- | ---: | ---: | ---: | ---: |")

    def row(what, samples, seconds):
        cells = " | ".join(f"{error:.3g}" for error in errors(samples, reference))
        print(f"| {what} | {cells} | {seconds:.3g} |", flush=True)

    for cells in MESHES:
        row(f"beltdrive, {cells} cells", *beltdrive(program, cells))
    for elements, step, contact in ELEMENTS:
        row(f"Exudyn, {elements} elements, {step:g} s, {contact:.0e} N/m²", *exudyn(elements, step, contact))


main()
