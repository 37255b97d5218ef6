"""The tree of a package, and its wheel for one Python and one kind of machine."""

import re
import subprocess
import sys
import sysconfig
from importlib.metadata import distribution
from pathlib import Path
from shutil import copytree, ignore_patterns
from typing import Final

LEFT_OUT: Final = ignore_patterns(
    ".*", "__pycache__", "build", "dist", "outputs", "*.egg-info", "benchmarks", "docs", "figures", "tests", "wheels"
)
SETUP: Final = """
import setuptools


class Compiled(setuptools.Distribution):
    def has_ext_modules(self) -> bool:
        return True  # the wheel is for one Python and one platform


setuptools.setup(distclass=Compiled)
"""


def copy(root: Path, tree: Path) -> None:
    """Copy what belongs into a wheel: a build leaves folders behind, and ships what an older one has left."""
    copytree(root, tree, ignore=LEFT_OUT)


def platform() -> str:
    """Return the platform of the wheel by pip's name: the oldest of those of numba, whose library the code needs."""
    lines = (distribution("numba").read_text("WHEEL") or "").splitlines()
    tags = [line.rpartition("-")[2].strip() for line in lines if line.startswith("Tag:")]
    usual = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return min({*tags} - {"any"}, key=lambda tag: [int(part) for part in re.findall("[0-9]+", tag)], default=usual)


def wheel(tree: Path, target: Path) -> Path:
    """Build the wheel of a tree into a folder, and return it."""
    target.mkdir(parents=True, exist_ok=True)
    (tree / "setup.py").write_text(SETUP, encoding="utf-8")
    options = {"--build-option": ["--quiet", "--plat-name", platform()]}
    code = f"from setuptools import build_meta; print(build_meta.build_wheel({str(target)!r}, {options!r}))"
    done = subprocess.run([sys.executable, "-c", code], cwd=tree, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(done.stderr)
    return target / done.stdout.splitlines()[-1]
