"""The command `gradhesion`: its sub-commands, and how it ends."""

import atexit
import io
import os
import sys
import threading
from contextlib import suppress
from typing import Any, Final, NoReturn

import click

from gradhesion.cli.commands.plan import init, plan, validate
from gradhesion.cli.commands.profile import profile
from gradhesion.cli.commands.results import explore, info, plot, select, verify
from gradhesion.cli.commands.run import run
from gradhesion.cli.commands.setup import completion, schema, warmup
from gradhesion.cli.commands.status import merge, status
from gradhesion.cli.errors import GradhesionError, OutputError
from gradhesion.cli.installation import misfit, refuse_without_threads
from gradhesion.cli.terminal import interrupts, messages

INTERRUPTED = 130
UNHEARD = 141
"""As of a program that SIGPIPE ends."""


SECTIONS: Final = {
    "Study and run": (init, validate, plan, run, status, profile),
    "Results": (info, plot, explore, select, verify, merge),
}
"""The commands of a user, in the order of the work."""
SET_UP: Final = (warmup, completion, schema)
"""Commands for an installation, a shell and an editor, each needed once if at all: they have one line together."""
EXITS: Final = (
    "0 success, 2 wrong command, study or dataset, 3 failed or doubtful scenes, 4 the output cannot be written, "
    f"{INTERRUPTED} interrupted, {UNHEARD} the reader of the output has closed it"
)
"""The exit codes in short."""


class Commands(click.Group):
    """The commands in sections, and the exit codes after them; what a user can fix is printed without a traceback."""

    def invoke(self, context: click.Context) -> Any:
        """Run a command, which may compile unless its help is asked for."""
        try:
            if not {"-h", "--help"} & {*context.args}:
                refuse_without_threads()
            return super().invoke(context)
        except GradhesionError as error:
            raise messages.Failure(error) from error

    def format_commands(self, _context: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the sections, and in short what stands beside them: help fits a screen."""
        width = len("Exit codes:") - 2
        for words, commands in SECTIONS.items():
            with formatter.section(words):
                rows = [(f"{one.name:{width}}", one.get_short_help_str(formatter.width)) for one in commands]
                formatter.write_dl(rows)
        formatter.write_paragraph()
        formatter.write_dl([("Set up:", ", ".join(str(one.name) for one in SET_UP)), ("Exit codes:", EXITS)])


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(package_name="gradhesion")
def cli() -> None:
    """Exact maps of the adhesion of wavy punches on power-law graded materials.

    A study in TOML becomes a dataset in NetCDF; COMMAND --help has an example.
    """


for _commands in (*SECTIONS.values(), SET_UP):
    for _command in _commands:
        cli.add_command(_command)


def main() -> NoReturn:
    """Run the command line, and leave with the exit code of how it went."""
    try:
        messages.open_streams()
        interrupts.listen()
        code = cli.main(prog_name="gradhesion", standalone_mode=False) or 0
    except SystemExit as end:  # so click leaves where the reader of its output has gone, as `| head` does
        code = 0 if end.code == 0 else UNHEARD  # and, with 0, where it has completed a line for the shell
    except (Exception, KeyboardInterrupt) as error:  # noqa: BLE001 (raised again where no user can fix it)
        code = _code_of(error)
    # A failed or interrupted run may leave a block in work and a file that HDF5 cannot flush: wait for neither. Of a
    # command that has done its work nothing is left but modules, which take a seventh of a short one to take apart.
    if code == 0:
        with suppress(KeyboardInterrupt):  # as Python does first at its end
            threading._shutdown()  # type: ignore[attr-defined] # noqa: SLF001 (of pools of processes too)
            atexit._run_exitfuncs()  # noqa: SLF001
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError, AttributeError):
            stream.flush()
    os._exit(code)


def _code_of(error: BaseException) -> int:
    """Report to the user what has ended the command, and to the shell by a code; an error of the program is raised."""
    # What an interrupt breaks can look like anything, an ImportError for one.
    if interrupts.heard() or isinstance(error, KeyboardInterrupt | click.Abort):
        messages.say(interrupts.last_words())
        return INTERRUPTED
    if isinstance(error, MemoryError):
        error = messages.Failure(OutputError("there is not enough memory; split the study, or give it more memory"))
    elif isinstance(error, OSError):  # what the system refuses is no error of the program
        where = error.filename or (error.errno and "standard output")
        refused = f"{where}: {error.strerror or error}" if where else str(error)
        error = messages.Failure(OutputError(f"{refused}; fix this and run the command again"))
    elif (unmet := misfit(error)) is not None:
        error = messages.Failure(unmet)
    if isinstance(error, messages.Failure):
        error.show()
        return error.exit_code
    if isinstance(error, click.ClickException):
        text = io.StringIO()
        error.show(text)
        messages.complain(text.getvalue().rstrip())
        return error.exit_code
    raise error
