"""The command `gradhesion`: its sub-commands, and how it ends."""

import os
import sys
from contextlib import suppress
from typing import Any, NoReturn

import click

from gradhesion.cli import interrupts, messages
from gradhesion.cli.commands.explore import explore
from gradhesion.cli.commands.info import info
from gradhesion.cli.commands.init import init
from gradhesion.cli.commands.merge import merge
from gradhesion.cli.commands.plan import plan
from gradhesion.cli.commands.plot import plot
from gradhesion.cli.commands.run import run
from gradhesion.cli.commands.status import status
from gradhesion.cli.commands.validate import schema, validate
from gradhesion.cli.commands.verify import verify
from gradhesion.cli.commands.warmup import warmup
from gradhesion.cli.errors import GradhesionError

INTERRUPTED = 130
UNHEARD = 141
"""As of a program that SIGPIPE ends."""


class _Group(click.Group):
    """The commands; what a user can mend is printed without a traceback."""

    def invoke(self, context: click.Context) -> Any:
        """Run a command."""
        try:
            return super().invoke(context)
        except GradhesionError as error:
            raise messages.Failure(error) from error


@click.group(cls=_Group, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(package_name="gradhesion")
def cli() -> None:
    """Exact maps of the adhesion of wavy punches on power-law graded materials.

    A study in TOML goes in, a dataset in NetCDF comes out, and a picture of it.

    Exit codes: 0 fine; 2 the command or the study is wrong; 3 written, but some scenes have failed, or values do not
    stand up to verify; 4 the output cannot be written; 130 interrupted; 141 nobody reads the output on (as with
    `| head`).
    """


cli.add_command(init)
cli.add_command(run)
cli.add_command(plan)
cli.add_command(status)
cli.add_command(merge)
cli.add_command(validate)
cli.add_command(schema)
cli.add_command(info)
cli.add_command(plot)
cli.add_command(explore)
cli.add_command(verify)
cli.add_command(warmup)


def main() -> NoReturn:
    """Run the command line, and leave with the exit code of how it went."""
    interrupts.listen()
    try:
        code = cli.main(prog_name="gradhesion", standalone_mode=False) or 0
    except SystemExit as end:  # so click leaves where the reader of its output has gone, as `| head` does
        code = 0 if end.code == 0 else UNHEARD  # and, with 0, where it has completed a line for the shell
    except (Exception, KeyboardInterrupt) as error:  # noqa: BLE001 (raised again where no user can mend it)
        code = _code_of(error)
    if code == 0:
        sys.exit(0)
    # A failed or interrupted run may leave a block in work and a file that HDF5 cannot flush: wait for neither.
    with suppress(BrokenPipeError):
        sys.stdout.flush()
        sys.stderr.flush()
    os._exit(code)


def _code_of(error: BaseException) -> int:
    """Tell the user what has ended the command, and the shell by a code; what is no-one's mistake stays an error."""
    # What an interrupt breaks can look like anything, an ImportError for one.
    if interrupts.heard() or isinstance(error, KeyboardInterrupt | click.Abort):
        with suppress(BrokenPipeError):
            messages.say("interrupted", interrupts.last_words(), exit_code=INTERRUPTED)
        return INTERRUPTED
    if isinstance(error, click.ClickException):
        with suppress(BrokenPipeError):
            if messages.in_json() and not isinstance(error, messages.Failure):
                messages.say_json("error", exit_code=error.exit_code, message=error.format_message())
            else:
                error.show()
        return error.exit_code
    raise error
