"""Drives as files, texts, dictionaries and with overrides."""

import sys
from pathlib import Path

import numpy as np
import pytest

import beltdrive

FLAT = {
    "belt": {"type": "flat", "axial_stiffness": "120 kN", "mass_per_length": 0.108},
    "friction": {"law": "coulomb", "coefficient": 0.4},
    "pulleys": {
        "driver": {"radius": "250 mm", "speed": "1000 rpm"},
        "driven": {"radius": np.float64(0.25)},
    },
    "layout": {"centre_distance": 1.4},
    "load": {"slack_tension": "400 N", "tight_tension": 700},
}


def values(drive: beltdrive.Drive) -> dict[str, object]:
    """All values of a state but the time that it took."""
    state = beltdrive.solve(drive).to_dict()
    state.get("convergence", {}).pop("seconds", None)
    return state


def test_a_file_its_text_and_a_path_are_the_same_drive(tmp_path: Path) -> None:
    text = beltdrive.example("kim2009-flat")
    path = tmp_path / "drive.toml"
    path.write_text(text, encoding="utf-8")
    states = [values(drive) for drive in (text, path, str(path))]
    assert states[0] == states[1] == states[2]


@pytest.mark.skipif(sys.version_info < (3, 11), reason="tomllib is of Python 3.11")
@pytest.mark.parametrize("name", beltdrive.examples())
def test_a_dictionary_is_the_drive_that_its_file_states(name: str) -> None:
    import tomllib

    text = beltdrive.example(name)
    assert values(tomllib.loads(text)) == values(text)


def test_numbers_of_a_dictionary_are_in_si_units() -> None:
    state = beltdrive.solve(FLAT)
    assert state.driver.angular_speed_rad_per_s == pytest.approx(1000 * np.pi / 30)
    tensions = state.tractive_tension_N
    assert state.driven.torque_N_m == pytest.approx((tensions.tight - tensions.slack) * 0.25)
    assert state.tension_N.to_dict() == {"slack": 400, "tight": 700}


def test_overrides_take_the_place_of_entries() -> None:
    state = beltdrive.solve(FLAT, load__tight_tension="0.8 kN")
    assert state.tension_N.tight == 800
    assert state.driven.torque_N_m == beltdrive.solve(FLAT, **{"load.tight_tension": 800}).driven.torque_N_m
    # An entry may be left out, and another one be stated in its place.
    by_torque = beltdrive.solve(FLAT, load__tight_tension=None, load__driven_torque="100 N*m")
    assert by_torque.driven.torque_N_m == pytest.approx(100)


def test_texts_may_hold_anything() -> None:
    title = 'a "b" \\ ü\tß'
    assert beltdrive.solve({**FLAT, "title": title}).title == title
    with pytest.raises(beltdrive.InputError, match="unknown"):
        beltdrive.solve({**FLAT, 'be "lt"': {"type": "flat"}})


@pytest.mark.parametrize(
    ("drive", "overrides", "words"),
    [
        ("belt = 1\n", {}, ["expected", "--> drive:1"]),
        ("belt = \n", {}, ["--> drive:1"]),
        (FLAT, {"friction__coeficient": 0.3}, ["unknown key `coeficient`", "did you mean `coefficient`?"]),
        (FLAT, {"load__tight_tension": "700 mm"}, ["tight_tension", "length"]),
        (FLAT, {"load__tight_tension": float("nan")}, ["tight_tension"]),
        (FLAT, {"load__tight_tension": True}, ["tight_tension"]),
        (FLAT, {"load__tight_tension": object()}, ["`load__tight_tension` is a number or a text"]),
        (FLAT, {"load__tight_tension": 300}, ["tight tension 300 N is below the slack tension 400 N"]),
        ({**FLAT, "belts": {}}, {}, ["unknown table", "belts"]),
        ({**FLAT, 1: 2}, {}, ["a key of a drive is a text, not 1"]),
        ({**FLAT, "title": None}, {}, ["`title`"]),
        (17, {}, ["a drive is a path, the text of a drive file or a dict, not int"]),
    ],
)
def test_a_fault_is_told_in_the_words_of_the_program(drive, overrides, words) -> None:
    with pytest.raises(beltdrive.InputError) as error:
        beltdrive.solve(drive, **overrides)
    assert not str(error.value).startswith("error")
    for word in words:
        assert word in str(error.value)


def test_a_missing_file_and_a_tolerance_out_of_range_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        beltdrive.solve(tmp_path / "none.toml")
    with pytest.raises(beltdrive.InputError, match="tolerance"):
        beltdrive.solve(FLAT, tolerance=0.5)
    with pytest.raises(beltdrive.InputError, match="did you mean `kim2009`"):
        beltdrive.example("kim2008")


def test_a_drive_without_a_steady_state_says_why() -> None:
    with pytest.raises(beltdrive.UnsolvedError, match="no steady state") as error:
        beltdrive.solve(beltdrive.example("kim2009"), load__tight_tractive_tension="20 kN")
    assert error.value.reason == "gross slip"
