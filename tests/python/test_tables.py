"""Tables are the files' numbers, column by column."""

import csv
import math

import numpy as np
import pytest

import weaveform as wf


def columns_by_csv(path):
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    return {name: [row[k] for row in rows[1:]] for k, name in enumerate(rows[0])}


@pytest.mark.parametrize("which", ["bias", "hemisphere"])
def test_history_is_the_files_numbers(which, request):
    result = request.getfixturevalue(which)
    expected = columns_by_csv(result.path / "history.csv")
    assert list(result.history) == list(expected)
    for name, cells in expected.items():
        assert result.history[name].dtype == np.float64
        assert result.history[name].tolist() == [float(cell) for cell in cells], name
    assert result.history.rows == len(cells)


def test_every_table_of_a_formed_part_is_the_files(hemisphere):
    files = sorted(file.name for file in hemisphere.path.glob("*.csv"))
    assert {"history.csv", "meridians.csv", "outline.csv", "sphere_net.csv"} <= set(files)
    for file in files:
        table = hemisphere.table(file)
        for name, cells in columns_by_csv(hemisphere.path / file).items():
            expected = [float(cell) if cell else math.nan for cell in cells]
            assert np.array_equal(table[name], expected, equal_nan=True), (file, name)


def test_units_are_those_in_the_names(hemisphere):
    units = hemisphere.history.units
    assert units["time_s"] == "s" and units["punch.displacement_mm"] == "mm" and units["punch.force_z_N"] == "N"
    assert units["punch.contact_area_mm2"] == "mm²" and units["internal_energy_mJ"] == "mJ" and units["energy_error"] == ""
    assert wf.words_of("top.force_N") == "top force (N)"
    assert wf.words_of("energy_error") == "energy error"


def test_an_unknown_column_names_those_there_are(bias):
    with pytest.raises(KeyError, match=r"no column 'top\.force'.*top\.force_N"):
        bias.history["top.force"]
    assert "top.force" not in bias.history and "top.force_N" in bias.history


def test_a_row_that_is_being_written_is_left_out(tmp_path):
    (tmp_path / "history.csv").write_text("time_s,a_N\n0,1\n0.5,2.5\n1.0,3.")
    table = wf.Table(tmp_path / "history.csv")
    assert table["a_N"].tolist() == [1, 2.5] and table.rows == 2


def test_a_table_of_headings_alone_has_empty_columns(tmp_path):
    (tmp_path / "history.csv").write_text("time_s,a_N\n")
    assert wf.Table(tmp_path / "history.csv")["a_N"].tolist() == []


def test_text_comments_and_empty_cells(tmp_path):
    (tmp_path / "study.csv").write_text('# made by hand\ncase,law,error,force_N\n1234,"slack, soft","two\nlines",\n5e10,linear,,2\n')
    table = wf.Table(tmp_path / "study.csv")
    assert table["case"].tolist() == ["1234", "5e10"] and table["law"].tolist() == ["slack, soft", "linear"]
    assert table["error"].tolist() == ["two\nlines", ""]
    assert math.isnan(table["force_N"][0]) and table["force_N"][1] == 2


@pytest.mark.parametrize("text, said", [("", "no heading"), ("a,b\n1,2\n1\n", ":3: has 1 cells, not 2"), (None, "cannot be read")])
def test_no_table_is_a_file_error_with_its_place(tmp_path, text, said):
    if text is not None:
        (tmp_path / "t.csv").write_text(text)
    with pytest.raises(wf.FileError, match=said) as caught:
        wf.Table(tmp_path / "t.csv")
    assert caught.value.code == 4 and str(tmp_path / "t.csv") in str(caught.value)
