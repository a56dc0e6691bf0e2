"""Finds the program, calls it, passes on what it says while it runs, and raises what it fails with."""

import os
import re
import shutil
import signal
import subprocess
import sys
import threading
from dataclasses import dataclass
from typing import List, Optional

from .errors import ProgramNotFound, error_class


@dataclass(frozen=True)
class Line:
    """One line of what the program says to standard error while it runs. str() is its text."""

    text: str
    kind: str  # "progress", "warning", "error" or "log"
    stage: Optional[str] = None  # of progress: what is under way, e.g. "solve"
    fraction: Optional[float] = None  # of progress: what is done of it, 0 to 1

    def __str__(self):
        return self.text


@dataclass(frozen=True)
class Answer:
    """What a call came to."""

    command: List[str]
    text: str  # the answer: standard output
    log: str  # what was said meanwhile: standard error

    @property
    def warnings(self):
        return [line[len("warning: ") :] for line in self.log.splitlines() if line.startswith("warning: ")]


def find_program(program=None):
    """The program's path: the argument, else the environment's WEAVEFORM, else `weaveform` on PATH; the first that is
    given counts. Raises ProgramNotFound when there is nothing to run there."""
    for given, origin in ((program, "program="), (os.environ.get("WEAVEFORM"), "the environment's WEAVEFORM")):
        if not given:
            continue
        found = shutil.which(os.path.expanduser(os.fspath(given)))
        if found is None:
            raise ProgramNotFound(f"{given}, from {origin}, is not a program that can be run; check path and permissions")
        return found
    found = shutil.which("weaveform")
    if found is None:
        raise ProgramNotFound(
            "weaveform is not on PATH; install the package, or say where the program is (build/bin/weaveform of a built"
            " repository) by program=... or the environment's WEAVEFORM"
        )
    return found


def version(program=None):
    """The program's version as it says it: number, commit, compiler, build, vector instructions."""
    return call(["--version"], program=program, progress=False).text.strip()


_progress = re.compile(r"^(?P<stage>.*?\S)\s+(?:\[[#.]*\] *)?(?P<percent>\d+) %")


def parse_line(text):
    """A Line of what was said."""
    for kind in ("warning", "error"):
        if text.startswith(kind + ": "):
            return Line(text, kind)
    found = _progress.match(text)
    if found and (" left " in text or "elapsed" in text):
        return Line(text, "progress", found["stage"], int(found["percent"]) / 100)
    return Line(text, "log")


def complaints(log):
    """The errors among what was said, without the word; a complaint of several lines stays one."""
    found = []
    for line in log.splitlines():
        if line.startswith("error: "):
            found.append(line[len("error: ") :])
        elif found and not line.startswith("warning: "):
            found[-1] += "\n" + line
    return found


def _listener(progress):
    """What is done with each line: a callable as it is; None: shown on sys.stderr; False: nothing."""
    if callable(progress):
        return progress
    if progress is False:
        return lambda line: None
    if progress is None or progress is True:
        return lambda line: print(line, file=sys.stderr, flush=True)
    raise TypeError("progress: give a function of one wf.Line, None (shown on sys.stderr) or False (not shown)")


def _end(process):
    """Asks the program to end, which leaves a checkpoint, and waits for it."""
    process.send_signal(signal.SIGINT)
    process.stderr.read()
    process.wait()


def _raise(exit_code, command, log, folder):
    code = 128 - exit_code if exit_code < 0 else exit_code  # as shells count an end by a signal
    lines = complaints(log) or [
        f"{os.path.basename(command[0])} ended by signal {-exit_code}" if exit_code < 0 else f"it ended with code {code}"
    ]
    error = error_class(code)(lines, command, folder, log)
    error.code = code
    raise error


def call(arguments, *, program=None, progress=None, folder=None):
    """Calls the program and returns its Answer.

    `progress` is a function called with each Line as it comes; None shows them on sys.stderr, False does not. An
    exception it raises, and Ctrl-C, end the program as a signal does (with a checkpoint, so that resume=True goes on)
    and come through. Raises ProgramNotFound and, by the exit code, InputError, PhysicsError, FileError, Interrupted or
    Defect, which carry `folder`."""
    command = [find_program(program), *map(os.fspath, arguments)]
    listen = _listener(progress)
    process = subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
        errors="replace",
    )
    answer, log = [], []
    reader = threading.Thread(target=lambda: answer.append(process.stdout.read()), daemon=True)
    reader.start()
    try:
        for line in process.stderr:
            log.append(line)
            listen(parse_line(line.rstrip("\n")))
        process.wait()
    except BaseException:
        _end(process)
        raise
    finally:
        reader.join()
        process.stdout.close()
        process.stderr.close()
    if process.returncode != 0:
        _raise(process.returncode, command, "".join(log), folder)
    return Answer(command, answer[0], "".join(log))
