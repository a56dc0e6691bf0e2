"""The program's commands as functions.

`overrides` is a mapping of scene (of compare: settings) keys, as the program's --set. Further keyword arguments are the
command's options by name, whatever they are (`weaveform help COMMAND`): threads=2 is --threads=2, trust_geo=True is
--trust-geo, a list repeats the option, a tuple is joined by commas. `output` is the folder written to, `program` where
the program is, `progress` what is done with the lines it says while it runs (program.call). They raise WeaveformError's
classes; relative paths are from the current folder."""

import os
from pathlib import Path

from .overrides import set_arguments
from .program import call
from .result import Comparison, Fit, Folder, Result, Study


def option_arguments(options):
    """Arguments for keyword arguments: True is the bare option; None and False leave it out."""
    arguments = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            arguments.append(option)
            continue
        for one in value if isinstance(value, list) else [value]:
            text = ",".join(map(str, one)) if isinstance(one, tuple) else str(one)
            arguments.append(f"{option}={text}")
    return arguments


def _default_folder(file):
    return Path("results") / Path(file).stem


def _call_into(kind, command, file, overrides, output, options):
    """Calls `command` with `file` into a folder and opens that as `kind`."""
    folder = Path(output) if output is not None else _default_folder(file)
    control = {name: options.pop(name, None) for name in ("program", "progress")}
    arguments = [*command, file, *set_arguments(overrides), f"--output={folder}", *option_arguments(options)]
    return kind(folder, call(arguments, folder=folder, **control))


def _call_in(folder, command, options):
    """Calls `command` with a result folder, to which it writes, and opens that."""
    control = {name: options.pop(name, None) for name in ("program", "progress")}
    return Result(folder, call([*command, folder, *option_arguments(options)], folder=folder, **control))


def _post_into(kind, command, folder, files, overrides, target, options):
    """Calls `post COMMAND` with a result folder and files into a folder and opens that as `kind`."""
    control = {name: options.pop(name, None) for name in ("program", "progress")}
    arguments = ["post", command, folder, *files, *set_arguments(overrides), f"--output={target}"]
    return kind(target, call(arguments + option_arguments(options), folder=target, **control))


def _folder_of(result):
    return result.path if isinstance(result, Result) else Path(result)


def run(scene, overrides=None, *, output=None, **options):
    """Meshes, solves and evaluates a scene file: its Result. `resume=True` goes on from a checkpoint."""
    return _call_into(Result, ["run"], scene, overrides, output, options)


def mesh(scene, overrides=None, *, output=None, **options):
    """Builds the mesh of a scene: a Result that has `mesh` and `scene`."""
    return _call_into(Result, ["mesh"], scene, overrides, output, options)


def drape(scene, overrides=None, *, output=None, **options):
    """Drapes the blank of a scene on its tool: a Result that has `drape` and `drape_summary`."""
    return _call_into(Result, ["drape"], scene, overrides, output, options)


def solve(result, **options):
    """Solves what is meshed, by its Result or folder: a Result that has `frames`, `history` and `statistics`."""
    return _call_in(_folder_of(result), ["solve"], options)


def post(result, **options):
    """Evaluates what is solved, also one under way: a Result that has `summary`."""
    return _call_in(_folder_of(result), ["post"], options)


def fit(file, *, output=None, **options):
    """A material card from raw tests, as a fit file describes them: a Fit, whose `card` a scene can name."""
    return _call_into(Fit, ["fit"], file, None, output, options)


def study(file, *, output=None, **options):
    """Runs a scene in many variants, as a study file describes them: a Study. jobs=N: cases at a time."""
    return _call_into(Study, ["study"], file, None, output, options)


def check(scene, overrides=None, *, program=None, progress=False, **options):
    """Checks a scene: its text with every default. Raises InputError with all mistakes. resolved=True: and what the
    program chooses where the scene leaves it open."""
    arguments = ["check", scene, *set_arguments(overrides), *option_arguments(options)]
    return call(arguments, program=program, progress=progress).text


def export(source, file, format, overrides=None, *, program=None, progress=False, **options):
    """Writes the mesh of a scene (file, folder or Result), or a formed result's fibre directions, for other codes; the
    path written. What the format does not carry is raised nowhere: read it with progress=None."""
    source = source.path if isinstance(source, Result) else source
    arguments = ["export", source, f"--format={format}", f"--output={os.fspath(file)}", *set_arguments(overrides)]
    call(arguments + option_arguments(options), program=program, progress=progress)
    return Path(file)


def report(result, file=None, *, program=None, progress=False, **options):
    """One HTML page of a result, which opens offline, by its Result or folder; the path written (default: report.html in the
    folder)."""
    folder = _folder_of(result)
    target = Path(file) if file is not None else folder / "report.html"
    arguments = ["post", "report", folder]
    if file is not None:
        arguments.append(f"--output={os.fspath(file)}")
    call(arguments + option_arguments(options), program=program, progress=progress)
    return target


def virtual(result, overrides=None, *, output=None, **options):
    """The simulation as an instrument would have measured it: a Folder of stages/, settings.toml and loads.csv."""
    folder = _folder_of(result)
    target = Path(output) if output is not None else folder / "virtual"
    return _post_into(Folder, "virtual", folder, [], overrides, target, options)


def compare(result, measurement, overrides=None, *, output=None, **options):
    """Measured point fields (files, or their folder) beside a result: a Comparison. settings=FILE: a settings file."""
    folder = _folder_of(result)
    files = measurement if isinstance(measurement, (list, tuple)) else [measurement]
    target = Path(output) if output is not None else folder / "comparison"
    return _post_into(Comparison, "compare", folder, files, overrides, target, options)
