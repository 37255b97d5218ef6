"""The command `gradhesion`: its sub-commands, and how it ends."""

import os
import sys
from typing import NoReturn

import click

from gradhesion.cli import interrupts
from gradhesion.cli.info import info
from gradhesion.cli.plot import plot
from gradhesion.cli.run import run

INTERRUPTED = 130


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(package_name="gradhesion")
def cli() -> None:
    """Exact maps of the adhesion of wavy punches on power-law graded materials.

    A study in TOML goes in, a dataset in NetCDF comes out, and a picture of it.

    Exit codes: 0 fine; 2 the command or the study is wrong; 3 written, but some scenes have failed; 4 the output
    cannot be written; 130 interrupted.
    """


cli.add_command(run)
cli.add_command(info)
cli.add_command(plot)


def main() -> NoReturn:
    """Run the command line, and leave with the exit code of how it went."""
    interrupts.listen()
    try:
        code = cli.main(prog_name="gradhesion", standalone_mode=False)
    except click.ClickException as error:
        error.show()
        code = error.exit_code
    except (click.Abort, KeyboardInterrupt):
        click.echo("interrupted; nothing was replaced, and nothing is left behind", err=True)
        code = INTERRUPTED
    if code in (0, None):
        sys.exit(0)
    # A failed or interrupted run may leave a block in work and a file that HDF5 cannot flush: wait for neither.
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)
