"""Follows a tutorial as a reader would, and holds it to what it says.

    follow.py PROGRAM [DOCUMENT] [--show]

Every line of the document's ```sh blocks is run in order, whatever program it calls, in one empty folder in which
`examples` and `python` are the project's and `weaveform` is PROGRAM; lines that say "# not run" are left out (not
those that say "# not run alone", which tests/robust/docs_commands_test.cpp leaves out, for it runs no other program
than weaveform), and "# exit N" is the exit code that is expected (0 otherwise). Every line of a ```text block must be
among what the commands of the ```sh block before it printed, in the same order: the same words, and numbers that
differ by 2 % or by one in the last printed digit at most. Times (a number before " s") and runs of blanks are not
compared; a line "..." stands for any lines, " ..." at the end of a line for any words. --show prints what came out.
Ends with 1, and what differs by line, when the document does not hold.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RELATIVE_TOLERANCE = 0.02
LONGEST_S = 1200  # of a command; under sanitizers all takes ten times as long

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
TIME = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)? s\b")


def blocks(text):
    """(kind, number of the first line, lines) of each fenced block of sh or text."""
    found, kind = [], None
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            kind = None if kind else line[3:].strip() or "none"
            if kind:
                found.append((kind, number + 1, []))
        elif kind:
            found[-1][2].append(line)
    return [block for block in found if block[0] in ("sh", "text")]


def commands(first, lines):
    """(line number, command, exit code expected) of each command that is to be run."""
    joined, begin = "", first
    for number, line in enumerate(lines, first):
        if not joined:
            begin = number
        joined += line
        if joined.endswith("\\"):
            joined = joined[:-1] + " "
            continue
        if joined.strip() and not re.search(r"#.*\bnot run\b(?! alone)", joined):
            code = re.search(r"#.*\bexit (\d+)", joined)
            yield begin, joined, int(code.group(1)) if code else 0
        joined = ""


def agree(said, came):
    """Whether two printed numbers are equal within the tolerance."""
    digits = len(said.partition(".")[2]) if "e" not in said.lower() else None
    last = 0.0 if digits is None else 10.0**-digits
    return abs(float(said) - float(came)) <= max(RELATIVE_TOLERANCE * abs(float(said)), 1.000001 * last)


def same_line(said, came):
    """Whether a line of the document is the line that was printed."""
    said, came = (TIME.sub("TIME s", line).split() for line in (said, came))
    if said[-1] == "...":
        said.pop()
        came = came[:len(said)]
    said, came = " ".join(said), " ".join(came)
    if NUMBER.sub("#", said) != NUMBER.sub("#", came):
        return False
    return all(agree(*pair) for pair in zip(NUMBER.findall(said), NUMBER.findall(came)))


def not_found(said, came, first):
    """Complaints about the lines of a text block, `came` being what was printed."""
    complaints, place = [], 0
    for number, line in enumerate(said, first):
        if not line.strip() or line.strip() == "...":
            continue
        at = next((i for i in range(place, len(came)) if same_line(line, came[i])), None)
        if at is None:
            complaints.append(f"{number}: this was not printed: {line}")
        else:
            place = at + 1
    return complaints


def follow(document, folder, show):
    environment = dict(os.environ, PATH=f"{folder / 'bin'}:{os.environ['PATH']}", LC_ALL="C.UTF-8")
    work, complaints, printed, told = folder / "work", [], [], 0
    for kind, first, lines in blocks(document.read_text()):
        if kind == "text":
            told += len(lines)
            complaints += not_found(lines, printed, first)
            continue
        printed = []
        for number, command, code in commands(first, lines):
            done = subprocess.run(["bash", "-c", command], cwd=work, env=environment, text=True, timeout=LONGEST_S,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            printed += done.stdout.splitlines()
            if show:
                print(f"$ {command}\n{done.stdout}", flush=True)
            if done.returncode != code:
                complaints.append(f"{number}: exit code {done.returncode} instead of {code}: {command}\n{done.stdout}")
    if not told:
        complaints.append("1: it has no printed output to be held to")
    return complaints


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("program", type=pathlib.Path)
    arguments.add_argument("document", type=pathlib.Path, nargs="?", default=ROOT / "docs" / "tutorial.md")
    arguments.add_argument("--show", action="store_true")
    given = arguments.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for made in ("bin", "work"):
            (folder / made).mkdir()
        (folder / "bin" / "weaveform").symlink_to(given.program.resolve())
        for linked in ("examples", "python"):
            (folder / "work" / linked).symlink_to(ROOT / linked)
        complaints = follow(given.document, folder, given.show)
    for complaint in complaints:
        print(f"{given.document.name}:{complaint}", file=sys.stderr)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
