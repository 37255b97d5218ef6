"""Names of files made at random of what shells, terminals, file systems and formats take for their own."""

import random
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Final

from tests.adversary.commands import fault_of

PIECES: Final = (
    "a", "\u00e9", "e\u0301", "\u202e", "\u2028", "\U0001f600", " ", "\n", "\r", "\t", "\x07", "\x1b[2J", "\x1b]0;x\x07", "\x7f", "\x9b",
    "-", "--", "-o", "=", "%s", "%00", "{0}", "$HOME", "$(x)", "`x`", "'", '"', "\\", "*", "?", "[", "]", "~", "#", ";", "&", "|", "<", ">",
    ":", "::", "http://", "file://", "?x=1", "..", "...", "nul", "con", ".parts", ".nc.parts", ".toml", ".part", "x" * 80, "\udcff", "\ufeff",
)  # fmt: skip
"""Of names."""
STUDY: Final = """\
outputs = ["pull_off_force"]
[parameters]
k = 0.3
nu = 0.3
modulus = 430.0
c0_over_R = 0.013
lambda_over_R = [0.2, 0.3]
A = 0.02
a_max_over_R = 1.7
"""


def name_of(draw: random.Random) -> str:
    """Make a name."""
    return "".join(draw.choice(PIECES) for _ in range(draw.choice([1, 2, 3, 5])))


def commands_on(folder: Path, draw: random.Random) -> Iterator[tuple[str, ...]]:
    """Give the commands that are tried on a study and a dataset with hostile names."""
    study, output = folder / f"{name_of(draw)}.toml", folder / f"{name_of(draw)}{draw.choice(['.nc', '', '.NC'])}"
    with suppress(OSError, ValueError):  # a name that the system refuses
        study.write_text(STUDY)
    for words in (
        ("validate", study), ("plan", study, "-o", output), ("run", study, "-o", output), ("run", study, "-o", output), ("status", output),
        ("info", output), ("verify", output, "--sample", "1"), ("merge", output), ("plot", output), ("explore", output),
        ("run", study, "-o", output, "--overwrite", "--quiet"), ("init", "-o", study), ("profile", output), ("info", study),
    ):  # fmt: skip
        yield tuple(str(word) for word in words)


def faults_of_names(folder: Path, count: int, draw: random.Random) -> list[tuple[str, str]]:
    """Try commands on names, and give what was wrong."""
    faults = []
    for number in range(count):
        inside = folder / str(number)
        inside.mkdir()
        (inside / "precious").write_text("mine")
        for name, *options in commands_on(inside, draw):
            if fault := fault_of(name, *options):
                faults.append((name, f"{fault} ({options})"))
        if (inside / "precious").read_text() != "mine":
            faults.append(("any", f"the file of somebody else has gone ({options})"))
    return faults
