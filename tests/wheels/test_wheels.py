"""A wheel with compiled kernels: nothing is compiled on a new machine, and the bits are those of a compilation here."""

import hashlib
import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest
from packaging.tags import sys_tags
from packaging.utils import parse_wheel_filename

from gradhesion.core.compiler.ahead import FEATURES
from gradhesion.core.compiler.probe import LAZY
from wheels import package
from wheels.__main__ import main

ROOT = Path(__file__).parents[2]

SWEEP = """
import hashlib, json, sys
import numpy as np
from gradhesion.core import CACHE_FOLDER, compiled_before, solve, watch_compilation
from gradhesion.core.compiler import sources
rng = np.random.default_rng(11)
n = 100_000
scenes = dict(
    k=rng.choice([0.0, 0.3, 0.8], n), nu=rng.uniform(-0.5, 0.4, n), modulus=10 ** rng.uniform(1, 4, n),
    c0_over_R=10 ** rng.uniform(-3, 0, n), lambda_over_R=10 ** rng.uniform(-3, 1, n),
    A=rng.choice([0.0, 1.0], n, p=[0.1, 0.9]) * 10 ** rng.uniform(-4, 0, n), a_max_over_R=10 ** rng.uniform(-1, 1, n),
)
names = []
with watch_compilation(names.append):
    found = solve(scenes, ["pull_off_force", "pull_off_radius"])
print(json.dumps({
    "core": str(sources.CORE),
    "names": names,
    "before": [compiled_before(kind) for kind in ("tables", "force", "energy")],
    "values": hashlib.sha256(b"".join(array.tobytes() for array in found.values())).hexdigest(),
    "solved": int(np.isfinite(found["pull_off_force"]).sum()),
    "kept": [path.name for path in CACHE_FOLDER.rglob("*.nb?")],
}))
"""


def swept(**environment: str) -> dict[str, Any]:
    """Solve scenes in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", SWEEP], env=os.environ | environment, cwd="/", capture_output=True, text=True, check=True
    )
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def sizes(folder: Path) -> dict[str, tuple[int, int]]:
    """Sizes and times of the files of a folder, but for Python's own cache."""
    files = (path for path in folder.rglob("*") if path.is_file() and path.suffix != ".pyc")
    return {str(path.relative_to(folder)): (path.stat().st_size, path.stat().st_mtime_ns) for path in files}


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A wheel with the kernels of the force, also of many smooth punches."""
    if not LAZY:
        pytest.skip("numba links in its own way: no code is carried")
    folder = tmp_path_factory.mktemp("wheel")
    command = [
        sys.executable,
        "-m",
        "wheels",
        "--kinds",
        "force",
        "smooth",
        "--target",
        folder / "dist",
        "--kept",
        folder / "kept",
    ]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    (path,) = (folder / "dist").iterdir()
    assert str(path) in done.stdout
    return path


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder in which it is installed."""
    folder = tmp_path_factory.mktemp("installed")
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", folder, wheel]
    subprocess.run(pip, check=True, env=os.environ | {"PIP_DISABLE_PIP_VERSION_CHECK": "1"})
    return folder


@pytest.mark.slow
def test_the_wheel_is_for_this_python_and_platform_and_no_other(wheel: Path) -> None:
    (tag,) = parse_wheel_filename(wheel.name)[-1]
    assert (tag.interpreter, tag.abi) == (f"cp{sys.version_info[0]}{sys.version_info[1]}",) * 2
    assert tag.platform == package.platform() != "any"
    assert tag in sys_tags()
    with zipfile.ZipFile(wheel) as archive:
        (name,) = [name for name in archive.namelist() if name.endswith(".dist-info/WHEEL")]
        assert "Root-Is-Purelib: false" in archive.read(name).decode().splitlines()
        manifest = json.loads(archive.read("gradhesion/core/x86-64-v3/manifest.json"))
        code = {name: archive.read(f"gradhesion/core/x86-64-v3/{name}") for name in manifest["kernels"]}
    assert manifest["kinds"] == ["force", "smooth", "tables"]
    assert manifest["features"] == [*FEATURES]
    assert {name: hashlib.sha256(data).hexdigest() for name, data in code.items()} == manifest["kernels"]


@pytest.mark.slow
def test_both_ways_give_the_same_bits_of_many_scenes(installed: Path, tmp_path: Path) -> None:
    before = sizes(installed)
    carried = swept(PYTHONPATH=str(installed), NUMBA_CACHE_DIR=str(tmp_path / "empty"))
    own = swept(GRADHESION_KERNELS="own")
    assert Path(carried["core"]) == installed / "gradhesion" / "core"
    assert Path(own["core"]) == ROOT / "core"
    assert carried["names"] == carried["kept"] == []
    assert carried["before"] == [True, True, False]
    assert carried["values"] == own["values"]
    assert carried["solved"] == own["solved"] > 90_000
    assert sizes(installed) == before, "nothing is written into the installation"


@pytest.mark.slow
def test_a_first_run_compiles_nothing(installed: Path, tmp_path: Path) -> None:
    (tmp_path / "force.toml").write_text(
        'outputs = ["pull_off_force"]\n[parameters]\nk = [0.0, 0.5]\nnu = 0.3\nmodulus = 500.0\nc0_over_R = 0.01\n'
        "lambda_over_R = 0.1\nA = [0.0, 0.03]\na_max_over_R = 1.0\n"
    )
    environment = os.environ | {"PYTHONPATH": str(installed), "NUMBA_CACHE_DIR": str(tmp_path / "empty")}
    run = [sys.executable, "-m", "gradhesion.cli", "run", "force.toml", "-o", "force.nc"]
    done = subprocess.run(run, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, "compil" in done.stderr) == (0, False), done.stderr
    assert "4 scenes" in done.stdout + done.stderr


def test_a_processor_that_cannot_run_the_code_builds_none(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(
        "llvmlite.binding.get_host_cpu_features", lambda: dict.fromkeys(FEATURES, True) | {"avx2": False}
    )
    monkeypatch.setattr(sys, "argv", ["wheels", "--target", str(tmp_path / "dist"), "--kept", str(tmp_path / "kept")])
    with pytest.raises(SystemExit, match=r"this processor lacks avx2$"):
        main()
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_numba_of_another_version_compiles_and_says_why(installed: Path, tmp_path: Path) -> None:
    code = (
        "import numba; numba.__version__ = '0.68.99'\n"
        "from gradhesion.core import compiled_before\nfrom gradhesion.core.compiler.ahead import why_not\n"
        "print(compiled_before('force'), why_not())"
    )
    environment = os.environ | {"PYTHONPATH": str(installed), "NUMBA_CACHE_DIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", code], cwd="/", env=environment, capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith(
        "False the compiled kernels that came with the program are not used: they are for numba "
    )
    assert done.stdout.endswith(", not 0.68.99\n")
