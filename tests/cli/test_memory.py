"""`gradhesion plan` promises how much memory a run takes, and no run takes more; where there is less, one sentence says so."""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from click.testing import Result

pytestmark = pytest.mark.slow

Call = Callable[..., Result]
SCENE = "nu = 0.3\nmodulus = 500.0\nc0_over_R = 0.01\nlambda_over_R = 0.1\na_max_over_R = 1.0\n"
FORCE = 'outputs = ["pull_off_force"]\n'
MAP = f"{FORCE}[parameters]\nk = 0.3\nA = {{ start = 0.0, stop = 0.1, num = 600_000 }}\n{SCENE}"
POINTS = f'layout = "points"\n{FORCE}[parameters]\nA = 0.02\npoints = "k.csv"\n{SCENE}'
SERIES = "[profile]\nharmonics = [{ n = 1, cos = 1.0 }, { n = 3, sin = 0.2 }]\n"
STUDIES = {
    "one scene": MAP.replace("{ start = 0.0, stop = 0.1, num = 600_000 }", "0.02"),
    "three blocks": MAP,
    "20,000 different k": POINTS,
    "4,000 of a series": POINTS + SERIES,
}


COUNTED = """\
import atexit, sys
from gradhesion.cli.main import main
atexit.register(lambda: print(*(line for line in open("/proc/self/status") if line.startswith("VmHWM"))))
main()
"""
"""A command that counts its own memory: what `getrusage` counts begins with that of the process that has started it."""


def peak(*words: str | Path) -> int:
    """Give the bytes that a command takes at most."""
    done = subprocess.run([sys.executable, "-c", COUNTED, *words], capture_output=True, text=True, check=True)
    return 1024 * int(done.stdout.split()[1])


@pytest.mark.skipif(sys.platform != "linux", reason="reads what Linux counts")
@pytest.mark.parametrize("name", STUDIES)
def test_a_run_takes_no_more_than_planned(name: str, gradhesion: Call, tmp_path: Path) -> None:
    many = 4_000 if "series" in name else 20_000
    np.savetxt(tmp_path / "k.csv", np.random.default_rng(3).uniform(0, 1, many), header="k", comments="")
    study = tmp_path / "study.toml"
    study.write_text(STUDIES[name])
    promised = json.loads(gradhesion("plan", study, "--json").stdout)["bytes_of_memory"]
    taken = peak("run", study, "-o", tmp_path / "out.nc", "--quiet", "--threads", "2")
    assert taken <= promised
    assert promised <= 1.4 * taken, "a promise that is of use"


COMMANDS = (
    "--version", "schema", "completion bash", "init jkr -o new.toml", "validate study.toml", "plan study.toml", "run study.toml -o new.nc",
    "run --help", "status out.nc", "info out.nc", "plot out.nc", "explore out.nc", "verify out.nc --sample 1", "merge out.nc -o joined.nc",
    "profile tip.csv", "warmup",
)  # fmt: skip


@pytest.mark.skipif(sys.platform != "linux", reason="counts pages of Linux")
def test_with_little_address_space_each_command_works_or_says_so(
    gradhesion: Call, study_file: Path, tmp_path: Path
) -> None:
    """What works in little works in more: each is tried in ever more, until it does."""
    import resource

    assert gradhesion("run", study_file, "-o", tmp_path / "out.nc", "--quiet").exit_code == 0
    left, refused = COMMANDS, {}
    for in_words in ("300.0 MB", "700.0 MB", "1.6 GB"):
        size = int(float(in_words[:-3]) * (10**9 if "GB" in in_words else 10**6))
        tried, left = left, ()
        for command in tried:
            done = subprocess.run(
                [sys.executable, "-m", "gradhesion.cli", *command.split()],
                preexec_fn=lambda size=size: resource.setrlimit(resource.RLIMIT_AS, (size, size)),
                cwd=tmp_path,
                capture_output=True,
                text=True,
                check=False,
                timeout=600,
            )
            assert done.returncode in (0, 2, 4), (command, done.stderr)
            assert "Traceback" not in done.stderr, command
            if "of address space" in done.stderr:
                assert done.returncode == 4
                assert done.stderr.startswith(f"the shell allows {in_words} of address space")
                left = (*left, command)
            elif done.returncode == 2:
                assert command in ("profile tip.csv", "merge out.nc -o joined.nc"), (command, done.stderr)
        refused[in_words] = [command.split()[0] for command in left]
    reading = ["info", "plot", "explore", "verify", "merge", "profile", "warmup"]
    assert [*refused.values()] == [["validate", "plan", "run", *reading], ["plan", "run", "warmup"], []]
