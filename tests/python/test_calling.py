"""The program is found, its lines come while it runs, its failures are exceptions with code and lines."""

import os
import pickle
import signal
import subprocess
import time
from pathlib import Path

import pytest

import weaveform as wf
from conftest import small


@pytest.fixture
def scene(examples):
    return examples / "bias_extension_pw.toml"


def script(folder, text):
    """A stand-in for the program."""
    file = folder / "weaveform"
    file.write_text("#!/bin/sh\n" + text)
    file.chmod(0o755)
    return file


def test_argument_counts_before_environment_and_environment_before_path(tmp_path, monkeypatch):
    places = {}
    for name in ("argument", "environment", "path"):
        (tmp_path / name).mkdir()
        places[name] = str(script(tmp_path / name, ""))
    monkeypatch.setenv("PATH", str(tmp_path / "path"))
    monkeypatch.setenv("WEAVEFORM", places["environment"])
    assert wf.find_program(places["argument"]) == places["argument"]
    assert wf.find_program() == places["environment"]
    monkeypatch.delenv("WEAVEFORM")
    assert wf.find_program() == places["path"]


def test_no_program_is_said_with_what_to_do(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("WEAVEFORM")
    with pytest.raises(wf.ProgramNotFound, match="not on PATH.*program=.*WEAVEFORM"):
        wf.program_version()
    with pytest.raises(wf.ProgramNotFound, match="/nowhere/weaveform, from program="):
        wf.program_version("/nowhere/weaveform")
    monkeypatch.setenv("WEAVEFORM", "/nowhere/else")
    with pytest.raises(wf.ProgramNotFound, match="/nowhere/else, from the environment's WEAVEFORM"):
        wf.program_version()


def test_all_mistakes_of_a_scene_are_lines_of_one_error(scene):
    with pytest.raises(wf.InputError) as caught:
        wf.check(scene, {"blank.coarsning": 2, "no.key": 1})
    assert caught.value.code == 2
    assert len(caught.value.lines) == 2
    assert any("blank.coarsning" in line and "did you mean 'coarsening'?" in line for line in caught.value.lines)
    assert any(line.startswith("--set no.key: unknown table 'no'") for line in caught.value.lines)
    assert str(caught.value) == "\n".join(caught.value.lines)


def test_a_mistake_in_the_file_has_its_place(tmp_path):
    (tmp_path / "scene.toml").write_text('[fabric]\nmaterial = "twintex-pw"\n\n[blank]\nsize = "wide"\n')
    with pytest.raises(wf.InputError, match=r"scene\.toml:5:\d+: "):
        wf.check(tmp_path / "scene.toml")


def test_a_mistyped_option_is_told_the_nearest(scene):
    with pytest.raises(wf.InputError, match="did you mean '--threads'"):
        wf.run(scene, thread=2, progress=False)


def test_failed_physics_leaves_what_came_before(scene, tmp_path):
    wild = {**small, "analysis.energy_limit": 1e-6}
    with pytest.raises(wf.PhysicsError) as caught:
        wf.run(scene, wild, output=tmp_path / "wild", progress=False)
    assert caught.value.code == 3 and caught.value.lines
    assert len(wf.open(caught.value.folder).frames) >= 1


def test_missing_files_are_file_errors(tmp_path):
    with pytest.raises(wf.FileError) as caught:
        wf.check(tmp_path / "nothing.toml")
    assert caught.value.code == 4 and "nothing.toml: cannot be read" in caught.value.lines[0]


@pytest.mark.parametrize("code, kind", [(1, wf.Defect), (2, wf.InputError), (3, wf.PhysicsError), (4, wf.FileError),
                                        (130, wf.Interrupted), (99, wf.Defect)])
def test_each_exit_code_has_its_class(tmp_path, code, kind):
    program = script(tmp_path, f"echo 'error: one' >&2; echo 'of two lines' >&2; echo 'error: two' >&2; exit {code}\n")
    with pytest.raises(wf.WeaveformError) as caught:
        wf.program_version(program)
    assert type(caught.value) is kind
    assert caught.value.code == code
    assert caught.value.lines == ["one\nof two lines", "two"]


def test_a_killed_program_says_by_what(tmp_path):
    with pytest.raises(wf.Defect, match="signal 9") as caught:
        wf.program_version(script(tmp_path, "kill -9 $$\n"))
    assert caught.value.code == 137


def test_errors_survive_pickling(scene):
    with pytest.raises(wf.InputError) as caught:
        wf.check(scene, {"x.y": 1})
    again = pickle.loads(pickle.dumps(caught.value))
    assert (type(again), again.lines, again.code, again.command) == (
        wf.InputError, caught.value.lines, 2, caught.value.command)


def test_lines_come_while_the_program_runs(tmp_path):
    program = script(tmp_path, "echo 'solve  10 %  step 1  left 0:01' >&2; read x < gate; echo 'warning: late' >&2\n"
                     .replace("gate", str(tmp_path / "gate")))
    os.mkfifo(tmp_path / "gate")
    heard = []

    def listen(line):  # the program does not go on, and the call would not end, were lines kept back
        heard.append(line)
        if line.kind == "progress":
            (tmp_path / "gate").write_text("go\n")

    answer = wf.call([], program=program, progress=listen)
    assert [(line.kind, line.stage, line.fraction) for line in heard] == [("progress", "solve", 0.1), ("warning", None, None)]
    assert answer.warnings == ["late"]


def test_a_run_tells_its_progress_from_0_to_1(scene, tmp_path, capsys):
    heard = []
    result = wf.run(scene, small, output=tmp_path / "told", progress=heard.append)
    fractions = [line.fraction for line in heard if line.kind == "progress" and line.stage == "solve"]
    assert fractions[0] == 0 and fractions[-1] == 1 and fractions == sorted(fractions) and len(fractions) > 3
    assert capsys.readouterr().err == ""
    assert "".join(f"{line}\n" for line in heard) == result.answer.log
    assert "largest |shear angle|" in result.answer.text


def test_by_itself_a_run_is_shown_on_standard_error(scene, tmp_path, capsys):
    wf.mesh(scene, small, output=tmp_path / "shown")
    assert "mesh.vtu for ParaView" in capsys.readouterr().err


def test_an_exception_of_the_listener_ends_the_run_with_a_checkpoint_to_go_on_from(scene, tmp_path):
    class Enough(Exception):
        pass

    def listen(line):
        if line.kind == "progress" and line.fraction >= 0.1:
            raise Enough

    long = {**small, "analysis.duration": 0.8, "output.history": 20}
    with pytest.raises(Enough):
        wf.run(scene, long, output=tmp_path / "stopped", progress=listen)
    stopped = wf.open(tmp_path / "stopped")
    assert (tmp_path / "stopped" / "checkpoint.bin").exists() and not stopped.finished
    resumed = wf.run(scene, long, output=tmp_path / "stopped", progress=False, resume=True)
    assert resumed.finished
    whole = wf.run(scene, long, output=tmp_path / "whole", progress=False)
    assert (resumed.path / "history.csv").read_bytes() == (whole.path / "history.csv").read_bytes()


def test_a_signal_to_the_program_raises_interrupted(scene, tmp_path):
    program = script(tmp_path, f'echo $$ > "{tmp_path}/pid"; exec "{wf.find_program()}" "$@"\n')

    def stop(line):
        if line.kind == "progress" and line.fraction >= 0.1:
            os.kill(int((tmp_path / "pid").read_text()), signal.SIGTERM)

    with pytest.raises(wf.Interrupted) as caught:
        wf.run(scene, {**small, "analysis.duration": 2.0}, output=tmp_path / "stopped", progress=stop, program=program)
    assert caught.value.code == 130 and caught.value.folder == tmp_path / "stopped"


def test_long_answers_and_logs_do_not_block_each_other(tmp_path):
    program = script(tmp_path, "i=0; while [ $i -lt 3000 ]; do echo out-$i-0123456789012345678901234567890123456789;"
                               " echo log-$i-0123456789012345678901234567890123456789 >&2; i=$((i+1)); done\n")
    begun = time.monotonic()
    answer = wf.call([], program=program, progress=False)
    assert answer.text.count("\n") == answer.log.count("\n") == 3000
    assert time.monotonic() - begun < 20


def test_the_folder_left_out_is_the_programs_own(examples, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = wf.mesh(examples / "bias_extension_pw.toml", small, progress=False)
    assert result.path == Path("results/bias_extension_pw")
    subprocess.run([wf.find_program(), "mesh", examples / "bias_extension_pw.toml", "--set=blank.coarsening=4"], check=True,
                   capture_output=True)
    assert [one.name for one in (tmp_path / "results").iterdir()] == ["bias_extension_pw"]
