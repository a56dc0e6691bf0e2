"""Overrides arrive at the program as they stand in Python."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import weaveform as wf
from weaveform.commands import option_arguments
from weaveform.overrides import set_arguments, toml_value


@pytest.mark.parametrize("value", [
    True, False, 0, -3, 10**15, 0.1, 1 / 3, 5e-324, 1.7976931348623157e308, -0.0, float("inf"), "", "word", "two words",
    'quoted "and" \\ back', "a\nb\tc\x7f\x00", "grün ° 日本 🧵", "'single'", "[1, 2]", [], [1, 2.5], [[0, 0], [1, 2]],
    ["a", "b"], [{"a": 1, "b c": [True]}], "true", "1.5",
])
def test_values_come_back_from_toml_as_they_went_in(value):
    back = tomllib.loads(f"value = {toml_value(value)}")["value"]
    assert back == value and type(back) is type(value)


def test_numpy_values_are_their_python_ones():
    assert toml_value(np.float64(0.1)) == "0.1"
    assert toml_value(np.int32(3)) == "3"
    assert toml_value(np.bool_(True)) == "true"
    assert toml_value(np.array([[1, 2], [3, 4]])) == "[[1, 2], [3, 4]]"
    assert tomllib.loads("v = " + toml_value(np.float32(0.1)))["v"] == float(np.float32(0.1))
    assert toml_value(Path("a/b.toml")) == '"a/b.toml"'


@pytest.mark.parametrize("value", [None, object(), {1, 2}, 1j])
def test_what_no_scene_can_hold_is_refused_with_its_key(value):
    with pytest.raises(TypeError, match=r"^blank\.size: "):
        set_arguments({"blank.size": value})


def test_keys_may_be_nested_tables():
    assert set_arguments({"tools": {"punch": {"travel": 60}}, "blank.fit": "grips"}) == [
        "--set=tools.punch.travel=60", '--set=blank.fit="grips"']
    with pytest.raises(ValueError, match="a key is TABLE.KEY"):
        set_arguments({"blank.size=[1,2]": 3})


def test_the_program_takes_every_kind_of_value(examples):
    overrides = {
        "blank.size": np.array([123.4567890123, 246.0]), "blank.coarsening": [4, 4], "model.section": "incompressible",
        "analysis.step_check": False, "grip.top.travel": 12.345678901, "grip.0.name": "lower-jaw", "output.frames": np.int64(7),
        "analysis.gravity": (0, 0, -9810),
    }
    scene = tomllib.loads(wf.check(examples / "bias_extension_pw.toml", overrides))
    assert scene["blank"]["size"] == [123.4567890123, 246.0]
    assert scene["blank"]["coarsening"] == [4, 4]
    assert scene["model"]["section"] == "incompressible"
    assert scene["analysis"]["step_check"] is False
    assert [grip["name"] for grip in scene["grip"]] == ["lower-jaw", "top"]
    assert scene["grip"][1]["travel"] == 12.345678901
    assert scene["output"]["frames"] == 7
    assert scene["analysis"]["gravity"] == [0, 0, -9810]


def test_lists_of_lists_reach_tools(examples):
    speed = [[0, 0], [0.25, 1], [1, 0.5]]
    scene = tomllib.loads(wf.check(examples / "hemisphere_pw_fast.toml", {"tools": {"punch": {"speed": np.array(speed)}}}))
    assert scene["tools"]["punch"]["speed"] == speed


def test_options_are_the_commands_own():
    assert option_arguments({"threads": 2, "trust_geo": True, "yes": False, "jobs": None, "measure": ["a", "b"],
                             "position": (1, 2.5, 3)}) == [
        "--threads=2", "--trust-geo", "--measure=a", "--measure=b", "--position=1,2.5,3"]
