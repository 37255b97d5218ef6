"""Whether numba can be had to link kernels as one: tried once for a folder, undone where it fails."""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

BROKEN = {
    "a step is gone": "del untyped_passes.InlineInlinables",
    "code is written otherwise": "compiler.CompileResult._reduce = lambda self: ()",
}
CODE = """
import sys
from numba.core import codegen, compiler, event, registry, types, untyped_passes
exec(sys.argv[1])
usual = registry.cpu_target.target_context.codegen()._library_class, types.Function.get_call_type
compiled = []
class Heard(event.Listener):
    def on_start(self, started):
        compiled.append(started)
    def on_end(self, ended):
        pass
event.register("numba:compile", Heard())
from gradhesion.core.compiler.probe import LAZY
again = registry.cpu_target.target_context.codegen()._library_class, types.Function.get_call_type
print(LAZY, bool(compiled), again == usual)
"""


def tried(folder: Path, change: str = "") -> list[str]:
    """Report whether kernels are linked as one, whether any was compiled for it, and whether numba is as it was."""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(folder), "GRADHESION_LINKING": ""}
    command = [sys.executable, "-c", CODE, change]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    return done.stdout.split()


def test_it_is_tried_once_and_others_wait(tmp_path: Path) -> None:
    with ThreadPoolExecutor(2) as pool:
        first, second = pool.map(lambda _: tried(tmp_path), range(2))
    works, compiled, _ = first
    assert [works, str(works == "False")] == [second[0], second[2]]
    assert {compiled, second[1]} == {"True", "False"}
    (mark,) = (path for path in tmp_path.rglob("linking-*") if not path.suffix)
    assert mark.read_text() == {"True": "as one", "False": "one by one"}[works]


@pytest.mark.parametrize("change", BROKEN.values(), ids=BROKEN)
def test_a_version_with_other_interfaces_links_its_own_way(tmp_path: Path, change: str) -> None:
    assert tried(tmp_path, change)[::2] == ["False", "True"]
    (mark,) = (path for path in tmp_path.rglob("linking-*") if not path.suffix)
    assert mark.read_text() == "one by one"


def test_a_trial_that_ended_the_process_is_not_made_again(tmp_path: Path) -> None:
    with pytest.raises(subprocess.CalledProcessError):
        tried(tmp_path, "codegen.JITCodeLibrary.finalize = lambda self: None")
    assert tried(tmp_path) == ["False", "False", "True"]
