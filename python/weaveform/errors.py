"""What goes wrong, as exceptions: one class for each exit code of the program.

`code` is the exit code, `lines` the complaints as the program wrote them ("file:line:column: what is wrong; what to
do"), one text each, `command` what was called, `log` all it said to standard error, `folder` where results lie, if any.
"""


class WeaveformError(Exception):
    """Anything that the program, or the reading of its results, fails with. str() is its lines, one below another."""

    code = None

    def __init__(self, lines, command=(), folder=None, log=""):
        super().__init__(lines, command, folder, log)  # so that it can be pickled, for pools of processes
        self.lines = [lines] if isinstance(lines, str) else list(lines)
        self.command, self.folder, self.log = list(command), folder, log

    def __str__(self):
        return "\n".join(self.lines)


class InputError(WeaveformError):
    """Exit code 2: the scene, a card, a measurement or an argument is wrong. `lines` has all mistakes at once."""

    code = 2


class PhysicsError(WeaveformError):
    """Exit code 3: the analysis failed (unstable, tangled, energy balance lost). `folder` has what came before."""

    code = 3


class FileError(WeaveformError):
    """Exit code 4: a file is missing, damaged, cannot be read or written; or no memory is left."""

    code = 4


class Interrupted(WeaveformError):
    """Exit code 130: a signal stopped the program; a checkpoint is left, and `resume=True` goes on from it."""

    code = 130


class Defect(WeaveformError):
    """Exit code 1, or an end by a signal (`code` 128 + its number): a defect in Weaveform, or it was killed."""

    code = 1


class ProgramNotFound(WeaveformError):
    """There is no program to call; `code` is None."""


def error_class(exit_code):
    """The class that stands for an exit code other than 0."""
    known = (InputError, PhysicsError, FileError, Interrupted)
    return next((one for one in known if one.code == exit_code), Defect)
