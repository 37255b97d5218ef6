"""Nothing that other systems lack is used at import or on the usual way: what Windows has not is taken away here.

The engine of clusters is left out: Dask has its own ways on each system.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

WITHOUT = """
import builtins, importlib, json, os, pkgutil, signal, sys

missing = {"fcntl", "grp", "posix", "pwd", "resource", "syslog", "termios", "tty"}
plain = builtins.__import__

def without(name, globals=None, *rest, **named):
    if name in missing and str((globals or {}).get("__name__")).startswith("gradhesion."):
        raise ModuleNotFoundError(f"No module named {name!r}", name=name)  # libraries have ways of their own
    return plain(name, globals, *rest, **named)

builtins.__import__ = without
for name in ("SIGHUP", "SIGKILL", "SIGUSR1", "SIGUSR2", "SIGPIPE", "SIGALRM", "SIGQUIT"):
    delattr(signal, name)
for name in ("O_CLOEXEC", "O_DIRECTORY", "fork", "getpgid", "killpg", "sched_getaffinity"):
    delattr(os, name)

import gradhesion.cli
from gradhesion.cli.main import cli, main

for found in pkgutil.walk_packages(gradhesion.cli.__path__, "gradhesion.cli."):
    if not found.name.startswith("gradhesion.cli.work.cluster") and not found.name.endswith("__main__"):
        importlib.import_module(found.name)
*first, last = json.loads(sys.argv[1])
for arguments in first:
    assert not cli.main(arguments, prog_name="gradhesion", standalone_mode=False), arguments
sys.argv[1:] = last
main()
"""


@pytest.mark.slow
def test_a_study_is_run_shown_and_checked_without_what_windows_lacks(root: Path, tmp_path: Path) -> None:
    commands = [
        ["run", str(root / "configs" / "smoke.toml"), "-o", "smoke.nc"],
        ["status", "smoke.nc"],
        ["info", "smoke.nc"],
        ["plot", "smoke.nc"],
        ["explore", "smoke.nc"],
        ["verify", "smoke.nc", "--sample", "2", "--seed", "1"],
    ]
    command = [sys.executable, "-c", WITHOUT, json.dumps(commands)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, (done.stdout, done.stderr)
    assert done.stdout.endswith("values are within their stated errors\n"), "the last has come to its end"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["smoke.html", "smoke.nc", "smoke.png"]
