"""Each question, with an answer that is known."""

import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import beltdrive

KIM = beltdrive.example("kim2009")
FLAT = beltdrive.example("kim2009-flat")
CASES = beltdrive.example("serpentine-cases")


def test_limits_are_those_of_the_readme() -> None:
    limits = beltdrive.limits(KIM)
    assert limits.largest.tight_tractive_tension_N == pytest.approx(8221.0148, abs=1e-3)
    over_friction = beltdrive.limits(FLAT, parameter="friction.coefficient")
    assert 0 < over_friction.smallest.coefficient < 1.2
    of_loop = beltdrive.limits(beltdrive.example("serpentine"))
    assert of_loop.largest.load_factor > 1
    with pytest.raises(beltdrive.InputError, match="friction.law"):
        beltdrive.limits(KIM, parameter="friction.law")


def test_a_trace_has_its_ends() -> None:
    branch = beltdrive.trace(FLAT, "load.tight_tension", "500 N", 900)
    loads = np.array([point.tight_tension_N for point in branch.points])
    assert loads[0] == 500 and loads[-1] == 900 and (np.diff(loads) > 0).all()
    curve = beltdrive.trace(FLAT, "load.tight_tension", 0.2, 0.6, curve="friction.coefficient")
    limits = [point.tight_tension_N for point in curve.points]
    assert limits[-1] > 2 * limits[0]
    with pytest.raises(beltdrive.InputError, match="start and stop are the same value"):
        beltdrive.trace(FLAT, "load.tight_tension", "0.5 kN", 500)
    with pytest.raises(beltdrive.InputError, match="parameter and curve"):
        beltdrive.trace(FLAT, "load.tight_tension", 1, 2, curve="load.tight_tension")


def test_a_map_has_a_point_for_each_pair() -> None:
    axis = ("load_factor", 0.2, 1, 3)
    answer = beltdrive.map(CASES, y=axis)
    assert len(answer.points) % 3 == 0
    with pytest.raises(beltdrive.InputError, match="from 2 to 1000"):
        beltdrive.map(CASES, y=("load_factor", 0.2, 1, 1))
    with pytest.raises(beltdrive.InputError, match=r"y is \(key, start, stop, count\)"):
        beltdrive.map(CASES, y=("load_factor", 3))


def test_a_check_gives_a_verdict_and_a_report_a_page() -> None:
    checked = beltdrive.check(CASES)
    assert [case.verdict for case in checked.cases] == ["holds", "holds", "FAILS"]
    assert "alternator" in checked.cases[2].failures[0]
    page = beltdrive.report(CASES, pulley__alternator__torque="12 N*m")
    assert page.startswith("<!DOCTYPE html>") and page.endswith("</html>")
    assert "beltdrive.report('drive', pulley__alternator__torque='12 N*m')" in page
    with pytest.raises(beltdrive.InputError, match=r"no \[uncertainty\]"):
        beltdrive.check(FLAT, samples=10)


def test_a_rating_has_its_optimum_where_a_third_of_the_tension_is_left_to_the_speed() -> None:
    found = beltdrive.rating(beltdrive.example("crossed"))
    assert found.end == "lift-off"
    share = found.optimum.speed_rad_per_s / found.end_speed_rad_per_s
    assert share == pytest.approx(3**-0.5, rel=1e-2)
    part = beltdrive.rating(beltdrive.example("crossed"), "100 rpm", "200 rpm")
    assert part.optimum_at_end
    with pytest.raises(beltdrive.InputError, match="begin below its end"):
        beltdrive.rating(beltdrive.example("crossed"), "200 rpm", "100 rpm")


def test_a_simulation_tells_of_gross_slip() -> None:
    found = beltdrive.simulate(beltdrive.example("slip-pulse"), "30 ms")
    assert found.events[0].kind == "gross slip"
    with pytest.raises(beltdrive.InputError, match="transient"):
        beltdrive.simulate(FLAT, "1 s")


def test_an_interrupt_from_the_keyboard_ends_a_simulation() -> None:
    # A process in the background may have been started with interrupts ignored.
    script = """
import beltdrive, signal
signal.signal(signal.SIGINT, signal.default_int_handler)
print("begun", flush=True)
beltdrive.simulate(beltdrive.example("slip-pulse"), "50 s")
"""
    run = subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert run.stdout and run.stdout.readline() == "begun\n"
    time.sleep(0.5)
    run.send_signal(signal.SIGINT)
    _, errors = run.communicate(timeout=20)
    assert errors.splitlines()[-1] == "KeyboardInterrupt"


def test_tension_meets_the_margin_asked_for() -> None:
    found = beltdrive.tension(CASES, margin=1.7)
    assert min(case.slip_margin for case in found.cases) == pytest.approx(1.7, rel=1e-6)
    with pytest.raises(beltdrive.InputError, match="margin must be at least 1"):
        beltdrive.tension(CASES, margin=0.5)
    with pytest.raises(beltdrive.InputError, match="there is no pulley `fann`"):
        beltdrive.tension(CASES, margin=1.5, move="fann")


def test_a_design_is_a_drive_file_that_holds() -> None:
    found = beltdrive.design(beltdrive.example("fan-design"))
    assert found.feasible and found.drive_file is not None
    assert [case.verdict for case in beltdrive.check(found.drive_file).cases] == ["holds", "holds"]
    assert beltdrive.solve(KIM).drive_file is None


@pytest.mark.parametrize("as_columns", [False, True])
def test_a_calibration_takes_text_and_columns(as_columns: bool) -> None:
    data = beltdrive.example("flat-bench.csv")
    if as_columns:
        rows = [line.split(",") for line in data.splitlines() if line and not line.startswith("#")]
        data = {name: [row[place] for row in rows[1:]] for place, name in enumerate(rows[0])}
    found = beltdrive.calibrate(beltdrive.example("flat-bench"), data)
    text = str(found)
    assert "friction" in text
    with pytest.raises(beltdrive.InputError, match="differ in length"):
        beltdrive.calibrate(FLAT, {"a": [1], "b": [1, 2]})


def test_modes_of_a_running_belt() -> None:
    pulse = beltdrive.example("slip-pulse")
    found = beltdrive.modes(pulse, 2)
    assert "torsional" in str(found)
    with pytest.raises(beltdrive.InputError, match="start is given without stop"):
        beltdrive.modes(pulse, start="100 rpm")
    with pytest.raises(beltdrive.InputError, match="count must be from 1 to 40"):
        beltdrive.modes(pulse, 0)


def test_stability_and_sections() -> None:
    assert len(str(beltdrive.stability(FLAT, modes=3))) > 100
    with pytest.raises(beltdrive.InputError, match="modes must be from 1 to 60"):
        beltdrive.stability(FLAT, modes=0)
    assert "SPB" in str(beltdrive.sections())
    assert beltdrive.sections("SPB").sections[0].top_width.value_m == pytest.approx(0.0163)
    with pytest.raises(beltdrive.InputError, match="there is no section `SPBB`"):
        beltdrive.sections("SPBB")
