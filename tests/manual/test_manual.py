"""Every command and every example of the README and of the manual runs, and prints what the page shows.

What a page holds, in order, in the folder where the pages before it were done:

- ```` ```sh ````: commands, one a line (a `\\` at its end goes on), each ending with exit code 0.
- ```` ```console ````: commands after `$ `, each with what it prints below; `...` stands for anything. A command that
  ends with a comment `# exit code N` ends with N.
- ```` ```python ````: run in the page's one namespace; a block ```` ```output ```` after it is what it prints.
- ```` ```toml ````: a file, if `<!-- file: NAME -->` stands before it; else a part of a study, which is checked.

`<!-- not run: REASON -->` before a block leaves it out, and `<!-- smaller: KEY=VALUE KEY=VALUE -->` sets keys of the studies
that its `gradhesion run` compute, so that they take a moment.
"""

import contextlib
import io
import os
import re
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.rules.asked import checked
from tests.conftest import ROOT, command


def _in_order() -> tuple[Path, ...]:
    """List the README and the written pages of the manual, in the order of its table of contents."""
    index = ROOT / "docs" / "index.md"
    trees = re.findall(r"^```\{toctree\}(.*?)^```", index.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    names = [line for tree in trees for line in tree.split() if (ROOT / "docs" / f"{line}.md").is_file()]
    names = [name for name in names if not name.startswith("reference/")]  # generated, if they are there at all
    return (ROOT / "README.md", index, *(ROOT / "docs" / f"{name}.md" for name in names))


PAGES = _in_order()

_BLOCK = re.compile(r"((?:^<!--[^\n]*-->\n)*)^```([a-z{}_-]*)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_MARK = re.compile(r"<!-- (file|not run|smaller): (.*?) -->")


class Block(NamedTuple):
    """A fenced block of a page, with the marks that stand before it."""

    page: Path
    line: int
    language: str
    text: str
    marks: dict[str, str]

    @property
    def place(self) -> str:
        return f"{self.page.relative_to(ROOT)}:{self.line}"


class Command(NamedTuple):
    line: str
    printed: str = ""
    code: int = 0


def blocks_of(page: Path) -> list[Block]:
    text = page.read_text(encoding="utf-8")
    return [
        Block(page, text[: found.start(3)].count("\n"), found[2], found[3], dict(_MARK.findall(found[1])))
        for found in _BLOCK.finditer(text)
    ]


def commands_of(block: Block) -> Iterator[Command]:
    text = block.text.replace("\\\n", " ")
    if block.language == "sh":
        lines = [line.partition("  #")[0].strip() for line in text.splitlines()]
        yield from (Command(line) for line in lines if line and not line.startswith("#"))
        return
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        line, _, printed = part.partition("\n")
        line, _, comment = line.partition("  # ")
        code = re.search(r"exit code (\d+)", comment)
        yield Command(line.strip(), printed, int(code[1]) if code else 0)


def made_smaller(line: str, block: Block) -> str:
    """Give the studies that a command computes the keys that make them small."""
    sets = [f"--set {shlex.quote(pair)}" for pair in shlex.split(block.marks.get("smaller", ""))]
    return re.sub(r"gradhesion run(?= |$)", " ".join(["gradhesion run", *sets]), line)


def same(shown: str, printed: str) -> bool:
    """
    Compare what a page shows with what is printed, where `...` stands for anything.

    >>> same("a ... of 3 s\\n...", "a map of 3 s\\nand more\\n"), same("a", "b")
    (True, False)
    """
    pattern = ".*?".join(re.escape(part) for part in _tidy(shown).split("..."))
    return re.fullmatch(pattern, _tidy(printed), flags=re.DOTALL) is not None


def _tidy(text: str) -> str:
    """Leave out what cannot be seen."""
    return "\n".join(line.rstrip() for line in text.strip().splitlines())


pytestmark = pytest.mark.slow

BLOCKS = [block for page in PAGES for block in blocks_of(page)]
SHOWN = ("", "json", "mermaid", "output", "pycon", "text", "{eval-rst}", "{toctree}")
"""Languages of blocks that are looked at only."""
RUN = ("bash", "console", "python", "sh", "toml")
NOT_RUN = {
    "README.md": {"sets up an environment of its own"},
    "docs/first_steps.md": {"installs"},
    "docs/installation.md": {"installs", "compiles for a minute or more", "for start-up files of shells"},
    "docs/large.md": {"needs several machines", "tests/repository/test_cluster.py runs the scripts"},
}
"""Every page with blocks that are not run, and why: these are all."""
IN_A_SHELL = (ROOT / "README.md", "run")
"""What is met first is the command of the shell: a second or two each, so that the others are spared it."""
WHOLE = tomllib.loads(next(block.text for block in BLOCKS if block.language == "toml"))
"""The study of the README, which the parts of studies are added to."""


def _run_commands(block: Block, folder: Path) -> None:
    for one in commands_of(block):
        line = made_smaller(one.line, block)
        plain = line.startswith("gradhesion ") and not re.search(r"[|&;<>$`~]", line)
        if plain and (block.page, line.split()[1]) != IN_A_SHELL:
            code, printed = (done := command(*shlex.split(line)[1:])).exit_code, done.output
        else:
            code, printed = _in_a_shell(line, folder)
        assert code == one.code, f"{block.place}: {line}\n{printed}"
        if one.printed.strip():
            assert same(one.printed, printed), f"{block.place}: {line}\n{printed}"


def _in_a_shell(line: str, folder: Path) -> tuple[int, str]:
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])  # the installed command first
    own, bash = os.environ | {"PATH": path, "MPLBACKEND": "agg"}, ["bash", "-euo", "pipefail", "-c", line]
    ends = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    done = subprocess.run(bash, cwd=folder, env=own, text=True, timeout=600, check=False, **ends)
    return done.returncode, done.stdout


def _run_python(block: Block, namespace: dict[str, object]) -> str:
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block.text, block.place, "exec"), namespace)  # noqa: S102 (our own text)
    return printed.getvalue()


def _check_study(block: Block) -> None:
    table = tomllib.loads(block.text)
    study = {**WHOLE, **table}
    if study.get("kind") == "optimum":
        del study["outputs"]
    if "physical" in table and "parameters" not in table:
        study["parameters"] = {"k": 0.3, "nu": 0.3, "A": 0.02}
    if study.get("kind") == "fit":  # a whole one: its form is checked, its file is that of the page
        assert not checked(table).mistakes, block.place
    else:
        assert study_from(study).scenes >= 1, block.place


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder, empty and far from the repository, in which a reader does one page after the other."""
    return tmp_path_factory.mktemp("reader")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_a_page_does_what_it_says(page: Path, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In the folder of the pages before it, whose files it neither needs nor meets."""
    monkeypatch.chdir(folder)
    before = {path.name for path in folder.rglob("*") if path.is_file() and path.suffix != ".py"}
    done = "\n".join(block.text for block in blocks_of(page) if block.language in RUN and "not run" not in block.marks)
    assert [name for name in before if re.search(rf"(?<![\w.]){re.escape(name)}(?!\w)", done)] == []
    namespace: dict[str, object] = {}
    printed = ""
    for block in blocks_of(page):
        if "not run" in block.marks:
            continue
        if block.language in ("bash", "console", "sh"):
            _run_commands(block, folder)
        elif block.language == "python":
            printed = _run_python(block, namespace)
        elif block.language == "output":
            assert same(block.text, printed), f"{block.place}:\n{printed}"
        elif "file" in block.marks:
            (folder / block.marks["file"]).write_text(block.text, encoding="utf-8")
        elif block.language == "toml":
            _check_study(block)


def test_every_block_is_run_or_says_why_not() -> None:
    reasons: dict[str, set[str]] = {}
    for block in BLOCKS:
        assert block.language in (*RUN, *SHOWN), block.place
        if "not run" in block.marks:
            reasons.setdefault(str(block.page.relative_to(ROOT)), set()).add(block.marks["not run"])
    assert reasons == NOT_RUN
    run = [block for block in BLOCKS if block.language in RUN and "not run" not in block.marks]
    assert len(run) >= 40


def test_no_command_hides_in_an_indented_block_and_the_sources_that_are_named_exist() -> None:
    folders = ("api", "benchmarks", "cli", "core", "docs", "figures", "tests", "twin")
    sources = [f"/{path.relative_to(ROOT).as_posix()}" for name in folders for path in (ROOT / name).rglob("*.py")]
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        outside = re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
        assert not re.search(r"^    (gradhesion|make|pip|python) ", outside, flags=re.MULTILINE), page
        for named in re.findall(r"`([\w/]+\.py)\b", text):
            assert any(source.endswith(f"/{named}") for source in sources), f"{page.name}: {named}"
