"""Tables of drives, in Arrow and through the libraries that speak it."""

import math

import numpy as np
import pytest

import beltdrive

pa = pytest.importorskip("pyarrow")

FLAT = beltdrive.example("kim2009-flat")


def test_rows_have_the_numbers_of_their_drives() -> None:
    tight = [300.0, 800.0, 20_000.0, 2000.0]
    table = pa.table(beltdrive.solve_table(FLAT, pa.table({"load.tight_tension": tight})))
    assert table["row"].to_pylist() == [0, 1, 2, 3]
    assert table["load_tight_tension_N"].to_pylist() == tight
    assert table["status"].to_pylist() == ["answered", "answered", "no answer", "answered"]
    for row, load in zip(table.to_pylist(), tight):
        if row["status"] == "answered":
            state = beltdrive.solve(FLAT, load__tight_tension=load)
            assert row["driven_torque_N_m"] == pytest.approx(state.driven.torque_N_m, rel=1e-12)
            assert row["driven_wrap_angle_deg"] == pytest.approx(state.driven.wrap_angle_deg, rel=1e-12)
        else:
            with pytest.raises(beltdrive.UnsolvedError) as error:
                beltdrive.solve(FLAT, load__tight_tension=load)
            assert row["reason"] == error.value.reason
            assert row["description"] and row["driven_torque_N_m"] is None


def test_columns_have_units_and_others_are_carried_over() -> None:
    given = pa.table(
        {
            "name": ["a", None, "c"],
            "load.tight_tension [kN]": pa.array([1, 2, 3], pa.int16()),
            "friction.coefficient": pa.array([1.2, 1.0, 0.8], pa.float32()),
        }
    )
    table = pa.table(beltdrive.solve_table(FLAT, given, keep="name"))
    assert table.column_names[:4] == ["name", "row", "load_tight_tension_N", "friction_coefficient"]
    assert table["name"].to_pylist() == ["a", None, "c"]
    assert table["load_tight_tension_N"].to_pylist() == [1000, 2000, 3000]
    assert table["friction_coefficient"].to_pylist()[1] == 1
    metadata = table.schema.metadata
    assert metadata[b"drive_file.text"].decode() == FLAT and metadata[b"answer"] == b"solve"


def test_a_row_that_is_at_fault_keeps_its_place_among_many() -> None:
    count, bad = 25_000, 17_000
    tight = np.linspace(300, 3000, count)
    tight[bad] = math.nan
    answer = beltdrive.solve_table(FLAT, pa.table({"load.tight_tension": tight}))
    assert (len(answer), answer.answered) == (count, count - 1)
    assert answer.refusals == {"impossible input": 1}
    table = pa.table(answer)
    assert np.array_equal(table["row"], np.arange(count))
    row = table.slice(bad, 1).to_pylist()[0]
    assert row["status"] == "at fault" and row["load_tight_tension_N"] is None
    assert row["description"] == "row 17000 of table: `NaN` is not a finite number under `load.tight_tension`"
    answered = np.delete(np.asarray(table["driven_torque_N_m"]), bad)
    assert (np.diff(answered) > 0).all()


def test_missing_and_impossible_numbers_are_told_by_row() -> None:
    table = pa.table({"load.tight_tension": [500.0, None, -1.0, math.inf, 100.0]})
    answers = pa.table(beltdrive.solve_table(FLAT, table))
    assert answers["status"].to_pylist() == ["answered", *["at fault"] * 4]
    told = answers["description"].to_pylist()
    assert "missing number" in told[1] and "not a finite number" in told[3]
    assert "below the slack tension" in told[4]


@pytest.mark.parametrize("sizes", [[7], [1, 6], [3, 0, 4], [2, 2, 2, 1]])
def test_record_batches_make_no_difference(sizes: list[int]) -> None:
    values = np.linspace(400, 1000, 7)
    ends = np.cumsum([0, *sizes])
    batches = [
        pa.record_batch({"id": pa.array(range(a, b), pa.int64()), "load.tight_tension": values[a:b]})
        for a, b in zip(ends[:-1], ends[1:])
    ]
    whole = beltdrive.solve_table(FLAT, pa.table({"id": range(7), "load.tight_tension": values}), keep=["id"])
    parted = beltdrive.solve_table(FLAT, pa.Table.from_batches(batches), keep=["id"])
    assert pa.table(parted).equals(pa.table(whole))


def test_questions_of_a_table() -> None:
    table = pa.table({"load_factor": [0.5, 1.0, 3.0]})
    checked = pa.table(beltdrive.solve_table(beltdrive.example("serpentine-cases"), table, question="check"))
    assert checked["verdict"].to_pylist() == ["holds", "fails", "fails"]
    limits = beltdrive.solve_table(FLAT, pa.table({"friction.coefficient": [0.4, 0.8]}), question="limits")
    smaller, larger = pa.table(limits)["largest_tight_tension_N"].to_pylist()
    alone = beltdrive.limits(FLAT, friction__coefficient=0.8).largest.tight_tension_N
    assert smaller < larger == pytest.approx(alone, rel=1e-9)


def test_an_empty_table_has_the_columns_of_the_answers() -> None:
    table = pa.table({"load.tight_tension": pa.array([], pa.float64())})
    answer = beltdrive.solve_table(FLAT, table)
    assert len(answer) == 0 and answer.column_names == pa.table(answer).column_names
    assert "efficiency" in answer.column_names


def test_data_frames_go_in_and_out() -> None:
    columns = {"load.tight_tension": [500.0, 600.0], "bench": ["a", "b"]}
    torque = pa.table(beltdrive.solve_table(FLAT, pa.table(columns), keep="bench"))["driven_torque_N_m"].to_pylist()
    polars = pytest.importorskip("polars")
    frame = polars.DataFrame(beltdrive.solve_table(FLAT, polars.DataFrame(columns), keep="bench"))
    assert frame["driven_torque_N_m"].to_list() == torque and frame["bench"].to_list() == ["a", "b"]
    pandas = pytest.importorskip("pandas", "2.2")
    answer = beltdrive.solve_table(FLAT, pandas.DataFrame(columns), keep="bench")
    assert pa.table(answer).to_pandas()["driven_torque_N_m"].tolist() == torque


@pytest.mark.parametrize(
    ("columns", "options", "words"),
    [
        ({"load.tight_tention": [1.0]}, {}, ["unknown column `load.tight_tention`", "did you mean `load.tight_tension`?"]),
        ({"load.tight_tension [mm]": [1.0]}, {}, ["load.tight_tension [mm]"]),
        ({"load.tight_tension": ["700 N"]}, {}, ["`load.tight_tension` of the table holds no numbers", "keep="]),
        ({"load.tight_tension": [[1.0]]}, {}, ["holds no numbers"]),
        ({"load.tight_tension": [True]}, {}, ["holds no numbers"]),
        ({"load.tight_tension": [1.0]}, {"keep": ["id"]}, ["no column `id` to keep"]),
        ({"load.tight_tension": [1.0], "row": [1]}, {"keep": ["row"]}, ["`row` cannot be kept"]),
        ({"id": [1]}, {"keep": ["id"]}, ["the table has no columns"]),
        ({"load.tight_tension": [1.0]}, {"question": "design"}, ["no question `design`"]),
        ({"load_factor": [1.0]}, {"question": "limits"}, ["the load factor"]),
        ({"load.tight_tension": [1.0], "load_tight_tension_N": [1.0]}, {}, ["a second column"]),
    ],
)
def test_a_table_at_fault_is_refused(columns, options, words) -> None:
    with pytest.raises(beltdrive.InputError) as error:
        beltdrive.solve_table(FLAT, pa.table(columns), **options)
    for word in words:
        assert word in str(error.value)


def test_what_is_no_table_is_refused() -> None:
    with pytest.raises(beltdrive.InputError, match="a table has `__arrow_c_stream__`, .* not dict"):
        beltdrive.solve_table(FLAT, {"load.tight_tension": [1.0]})
    with pytest.raises(beltdrive.InputError, match="unknown key"):
        beltdrive.solve_table(FLAT + "\nbelts = 1\n", pa.table({"load.tight_tension": [1.0]}))

    class Closed:
        def __arrow_c_stream__(self, requested_schema=None):
            return 1

    with pytest.raises((TypeError, beltdrive.InputError)):
        beltdrive.solve_table(FLAT, Closed())
