"""What answers hold and how they show."""

import json
import pickle
import threading

import numpy as np
import pytest

import beltdrive


@pytest.fixture(scope="module")
def state() -> beltdrive.Answer:
    return beltdrive.solve(beltdrive.example("kim2009"))


def test_values_are_attributes_and_items(state: beltdrive.Answer) -> None:
    # The numbers of the README of the project.
    assert state.driven.angular_speed_rad_per_s == pytest.approx(102.69936, abs=1e-5)
    assert state.efficiency == pytest.approx(0.961362, abs=1e-6)
    assert state["driven"]["wrap_angle_deg"] is state.driven.wrap_angle_deg
    assert "driven" in dir(state) and "torque_N_m" in dir(state.driven)
    assert set(state) == set(state.to_dict())
    with pytest.raises(AttributeError, match="there is no value `torque`; expected one of .*torque_N_m"):
        state.driven.torque
    with pytest.raises(AttributeError):
        state.efficiency = 1.0


def test_profiles_are_arrays_that_are_not_copied(state: beltdrive.Answer) -> None:
    profile = state.profiles.driven
    tension = profile.tension_N
    assert isinstance(tension, np.ndarray) and tension.dtype == np.float64 and tension.ndim == 1
    assert tension.size == profile.arc_length_m.size > 50
    assert profile.tension_N is tension
    assert not tension.flags.owndata and not tension.flags.writeable
    assert tension.tolist() == state.to_dict()["profiles"]["driven"]["tension_N"]
    # They outlive the answer.
    largest = beltdrive.solve(beltdrive.example("kim2009")).profiles.driven.tension_N
    assert largest.max() == tension.max()


def test_an_answer_shows_as_table_html_json_and_csv(state: beltdrive.Answer) -> None:
    assert repr(state) == "<Answer: Kim 2009, table 3>"
    assert "146.221  N·m" in str(state)
    assert "lbf·ft" in state.table("us") and "N·m" not in state.table("us")
    html = state._repr_html_()
    assert "<td>146.221</td>" in html and html.count("<table") == html.count("</table>") > 2
    assert json.loads(state.to_json()) == state.to_dict()
    head, first = state.to_csv().splitlines()[:2]
    assert "tension_N" in head.split(",") and len(head.split(",")) == len(first.split(","))
    with pytest.raises(beltdrive.InputError, match="there are no units `metric`"):
        state.table("metric")


def test_an_answer_goes_to_other_processes(state: beltdrive.Answer) -> None:
    again = pickle.loads(pickle.dumps(state))
    assert isinstance(again, beltdrive.Answer)
    assert str(again) == str(state) and again.to_dict() == state.to_dict()
    assert np.array_equal(again.profiles.driven.tension_N, state.profiles.driven.tension_N)
    assert pickle.loads(pickle.dumps(again)).table("si") == state.table("si")


def test_other_threads_run_meanwhile() -> None:
    thread = threading.Thread(target=beltdrive.solve, args=[beltdrive.example("v-power")])
    thread.start()
    turns = 0
    while thread.is_alive():
        turns += 1
        thread.join(1e-4)
    # The solve takes some tenths of a second. With the lock held there would be a turn or two.
    assert turns > 20
