"""The command `gradhesion`: its sub-commands, and how it ends."""

import atexit
import io
import os
import re
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from typing import Any, Final, NoReturn

import click

from gradhesion.cli.commands.plan import init, plan, validate
from gradhesion.cli.commands.profile import profile
from gradhesion.cli.commands.results import explore, info, plot, select, verify
from gradhesion.cli.commands.run import run
from gradhesion.cli.commands.setup import completion, schema, warmup
from gradhesion.cli.commands.status import merge, status
from gradhesion.cli.errors import EXIT_CODES, GradhesionError, OutputError
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


class Commands(click.Group):
    """The commands in sections, and the exit codes after them; what a user can fix is printed without a traceback."""

    def main(  # type: ignore[override] # it ends the program or returns, as that of click
        self,
        args: Sequence[str] | None = None,
        prog_name: str | None = None,
        *,
        standalone_mode: bool = True,
        **more: Any,
    ) -> int:
        """Run a command and return its exit code, with which a program of its own ends; raise what no user can fix."""
        try:
            code = super().main(args, prog_name, standalone_mode=False, **more) or 0
        except SystemExit as end:  # so click leaves where the reader of its output has gone, as `| head` does
            code = 0 if end.code == 0 else UNHEARD  # and, with 0, where it has completed a line for the shell
        except (Exception, KeyboardInterrupt) as error:  # noqa: BLE001 (raised again where no user can fix it)
            code = _code_of(error)
        if standalone_mode:
            sys.exit(code)
        return code

    def format_commands(self, _context: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the sections, and in short what stands beside them: help fits a screen."""
        width = len("Exit codes:") - 2
        for words, commands in SECTIONS.items():
            with formatter.section(words):
                rows = [(f"{one.name:{width}}", one.get_short_help_str(formatter.width)) for one in commands]
                formatter.write_dl(rows)
        codes = ", ".join(f"{code} {re.split('[;:]', words)[0]}" for code, words in EXIT_CODES.items())
        formatter.write_paragraph()
        formatter.write_dl([("Set up:", ", ".join(str(one.name) for one in SET_UP)), ("Exit codes:", codes)])


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(package_name="gradhesion")
def cli() -> None:
    """Exact maps of the adhesion of wavy punches on power-law graded materials.

    A study in TOML becomes a dataset in NetCDF; COMMAND --help has an example.
    """
    refuse_without_threads()


for _commands in (*SECTIONS.values(), SET_UP):
    for _command in _commands:
        cli.add_command(_command)


def main() -> NoReturn:
    """Run the command line, and leave with the exit code of how it went."""
    try:
        messages.open_streams()
        interrupts.listen()
        code = cli.main(prog_name="gradhesion", standalone_mode=False)
    except KeyboardInterrupt as error:  # before the command has begun, or after it
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
        messages.say(interrupts.LAST_WORDS)
        return INTERRUPTED
    if isinstance(error, click.ClickException):
        text = io.StringIO()
        error.show(text)
        messages.complain(text.getvalue().rstrip())
        return error.exit_code
    if isinstance(error, MemoryError):
        error = OutputError("there is not enough memory; split the study, or give it more memory")
    elif isinstance(error, OSError):  # what the system refuses is no error of the program
        where = error.filename or (error.errno and "standard output")
        refused = f"{where}: {error.strerror or error}" if where else str(error)
        error = OutputError(f"{refused}; fix this and run the command again")
    elif not isinstance(error, GradhesionError):
        error = misfit(error) or error
    if not isinstance(error, GradhesionError):
        raise error
    messages.say(*error.mistakes)
    return error.exit_code
