"""The ways to fail: one exception and one exit code each; every message says what to do next.

They are plain exceptions, for the command line (`gradhesion.cli.main` prints them) as for a notebook.
"""

from collections.abc import Sequence
from typing import Final

EXIT_CODES: Final = {
    0: "success",
    2: "wrong command, study or dataset; or a package is missing or too old, no scheduler answers, or a worker has "
    "another version",
    3: "scenes without a value, or a fit in doubt: they are written, and their `status` reports why; a fit is in doubt "
    "if it did not converge, has a residual above its noise, has another minimum, or ends at an end of a range; "
    "`verify` has found a value beyond its stated error",
    4: "the output cannot be written: it exists, there is no space or no permission, another run is writing it, or "
    "blocks of another study are kept; or a cluster is lost; existing files are untouched",
    130: "interrupted: existing files are untouched, finished blocks are kept, and the same command resumes",
    141: "the reader of the output has closed it: as with `| head`",
}
"""What every exit code means."""


class GradhesionError(Exception):
    """A failure that the user can fix: `mistakes` has a sentence for each thing that is wrong, `str()` all of them."""

    exit_code: int = 1
    """What the command line returns for it."""

    def __init__(self, mistakes: str | Sequence[str]) -> None:
        super().__init__(mistakes)
        self.mistakes = (mistakes,) if isinstance(mistakes, str) else tuple(mistakes)

    def __str__(self) -> str:
        return "\n".join(self.mistakes)


class StudyError(GradhesionError, ValueError):
    """A study, or the arguments of a function in its place, are wrong."""

    exit_code = 2


class DatasetError(GradhesionError, ValueError):
    """A dataset cannot be read, or lacks what was requested."""

    exit_code = 2


class DoubtfulError(GradhesionError):
    """Scenes of a dataset have no value, a fit is not to be trusted, or values deviate by more than is stated."""

    exit_code = 3


class MissingExtraError(GradhesionError, ImportError):
    """A package is missing, for example an optional one, or its version is too old."""

    exit_code = 2


class SetupError(GradhesionError):
    """Kernels cannot be compiled; or a cluster cannot be used: no scheduler, or a worker of another version."""

    exit_code = 2


class OutputError(GradhesionError):
    """The output cannot be written."""

    exit_code = 4
