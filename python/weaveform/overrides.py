"""Overrides of scene and settings values, as the program's `--set KEY=VALUE`, whose values are TOML."""

import json
from collections.abc import Mapping
from os import PathLike, fspath


def toml_value(value, key="value"):
    """A Python value as TOML: bool, int, float, text, path, NumPy number or array, list or tuple, mapping (an inline
    table). Numbers keep all their digits. Raises TypeError, naming the key, for anything else."""
    if hasattr(value, "tolist"):  # NumPy's scalars and arrays
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return int.__repr__(value)
    if isinstance(value, float):
        return float.__repr__(value)  # inf and nan are spelled alike in TOML
    if isinstance(value, PathLike):
        value = fspath(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")  # JSON's escapes are TOML's too
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(one, key) for one in value) + "]"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{toml_value(str(k))} = {toml_value(v, key)}" for k, v in value.items()) + "}"
    what = "None; leave the key out instead" if value is None else f"a {type(value).__name__}"
    raise TypeError(f"{key}: {what}; give a bool, number, text, list or NumPy array")


def _flat(overrides, prefix=""):
    """(key, value) of nested tables: {"blank": {"coarsening": 2}} is {"blank.coarsening": 2}. No scene key takes a
    table as its value, so that a mapping is always a table of the scene."""
    for name, value in overrides.items():
        key = f"{prefix}{name}"
        if isinstance(value, Mapping):
            yield from _flat(value, key + ".")
        else:
            yield key, value


def set_arguments(overrides):
    """The program's arguments for a mapping of overrides, e.g. {"blank.coarsening": 2, "grip.top.travel": 40.0} or
    {"tools": {"punch": {"travel": 60}}}; keys are those of `weaveform keys`, elements of lists by name or from 0.
    Whether a key exists and a value fits it is the program's to say. Raises TypeError, ValueError."""
    arguments = []
    for key, value in _flat(overrides or {}):
        if "=" in key or not key.strip():
            raise ValueError(f"override '{key}': a key is TABLE.KEY, as \"blank.coarsening\"; its value stands beside it")
        arguments.append(f"--set={key}={toml_value(value, key)}")
    return arguments
