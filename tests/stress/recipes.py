"""The recipes of docs/architecture.md, followed in a copy of the sources: what they say is enough, in as many files.

A whole solver is compiled for it: `make stress` runs it.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from tests.conftest import ROOT

ROOMS = ("cli", "configs", "core", "twin")

RADIUS = "    out[PULL_OFF_RADIUS, i] = lowest.y * reduced[at.LENGTH, i]\n"
AREA = '    Output("pull_off_area", "contact area at pull-off (in R^2)", "area at pull-off", "cycle", "m^2", "pull-off", exact_alone=True),\n'
SPRING = "    elif punch.control == OWN_SPRING:\n"
SPRING += "        reduced[at.BY_LOAD, i] = load / depth / scenes[at.MODULUS, i]\n"
HEIGHT = """    Input("height_over_R", "amplitude A lambda/R of the waviness", r"$A\\lambda/R$", "0.002", NOT_NEGATIVE, gives="A",
          needs=("lambda_over_R",), follows=operator.truediv),
"""
Edits = list[tuple[str, str, str]]
INPUT: Edits = [("core/problem/inputs.py", '    Input("chi",', f'{HEIGHT}    Input("chi",')]
OUTPUT: Edits = [  # file, old, new
    ("core/scenes/results.py", "LOADING, UNLOADING,\n    TURN,", "LOADING, UNLOADING, AREA,\n    TURN,"),
    ("core/scenes/results.py", RADIUS, f"{RADIUS}    out[AREA, i] = math.pi * out[PULL_OFF_RADIUS, i] ** 2\n"),
    ("core/problem/outputs.py", '    Output("turning_radius",', f'{AREA}    Output("turning_radius",'),
]
CONTROL: Edits = [
    ("core/problem/control.py", '"load", "machine")', '"load", "machine", "own spring")'),
    ("core/scenes/reduced.py", "AT_LOAD, MACHINE = range(3)", "AT_LOAD, MACHINE, OWN_SPRING = range(4)"),
    ("core/scenes/reduced.py", "    elif punch.control == MACHINE:\n", f"{SPRING}    elif punch.control == MACHINE:\n"),
    ("cli/study/shape_words.py", '    "load": "load, so', '    "own spring": "displacement through a spring of stiffness E* R",\n    "load": "load, so'),
    ("cli/picture/pictured.py", '"load": "under controlled load"', '"own spring": "by its own spring", "load": "under controlled load"'),
]  # fmt: skip
PUNCH = "dict(k=0.3, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.2, A=[0.01, 0.03], a_max_over_R=1.0)"
CHECKED = f"""
two = gr.solve({PUNCH}, ["pull_off_area", "pull_off_radius"])
load = gr.solve({PUNCH}, ["pull_off_area", "pull_off_radius"], control="load")
for found in (two, load):
    assert np.allclose(found.pull_off_area, np.pi * found.pull_off_radius**2, rtol=1e-15, atol=0.0)
    assert found.pull_off_area.attrs["long_name"] == "contact area at pull-off (in R^2)"
for more in (dict(solver="envelope"), dict(solver="asymptotic"), dict(rate=dict(exponent=0.5), speed_over_reference=0.1)):
    try:
        gr.solve({PUNCH}, "pull_off_area", **more)
    except ValueError:
        continue
    raise AssertionError(more)
punch = {PUNCH}
two = gr.solve(punch | dict(A=[0.01, 0.02]), "pull_off_force")
del punch["A"]
heights = gr.solve(punch | dict(height_over_R=[0.002, 0.004]), "pull_off_force")
assert (heights.pull_off_force.values == two.pull_off_force.values).all()
assert heights.A.values.tolist() == [0.01, 0.02]
own = gr.solve({PUNCH}, "pull_off_force", control="own spring")
machine = gr.solve({PUNCH}, "pull_off_force", control="machine", machine_stiffness=1.0)
assert (own.pull_off_force == machine.pull_off_force).all()
assert own.attrs["control"] == "own spring"
"""


def test_the_recipes_are_enough_and_name_their_files(tmp_path: Path) -> None:
    """All are followed in one copy, so that it is compiled once."""
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    for what, edits in (("input", INPUT), ("output", OUTPUT), ("control", CONTROL)):
        (recipe,) = re.findall(rf"### Add an? {what}\n(.*?)(?=\n##|\Z)", page, re.DOTALL)
        assert [name for name, *_ in edits if f"`{name}`" not in recipe] == []
    package = tmp_path / "sources" / "gradhesion"
    ignored = shutil.ignore_patterns("__pycache__")
    shutil.copytree(ROOT / "api", package, ignore=ignored)
    for room in ROOMS:
        shutil.copytree(ROOT / room, package / room, ignore=ignored)
    for name, old, new in (*INPUT, *OUTPUT, *CONTROL):
        text = (package / name).read_text(encoding="utf-8")
        assert text.count(old) == 1, (name, old)
        (package / name).write_text(text.replace(old, new), encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": str(package.parent), "NUMBA_CACHE_DIR": str(tmp_path / "kernels")}
    code = f"import numpy as np, gradhesion as gr\nassert gr.__file__.startswith({str(package)!r})\n{CHECKED}"
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
