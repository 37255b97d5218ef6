"""The end of a command that has done its work."""

import subprocess
import sys
from pathlib import Path

SCRIPT = """\
import atexit, multiprocessing, sys
from concurrent.futures import ProcessPoolExecutor

import click
from gradhesion.cli import main


@click.command()
def pool():
    found = ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn"))
    click.echo(found.submit(abs, -3).result())
    found.shutdown(wait=False, cancel_futures=True)


if __name__ == "__main__":
    atexit.register(print, "tidied up")
    main.cli.add_command(pool)
    sys.argv = ["gradhesion", "pool"]
    main.main()
"""


def test_it_waits_for_no_processes_and_tidies_up(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "3\ntidied up\n", "")
