"""Take the pages of the manual apart into what can be run, and run it.

What a page holds, in order, in the folder where the pages before it were done:

- ```` ```sh ````: commands, one a line (a `\\` at its end goes on), each ending with exit code 0.
- ```` ```console ````: commands after `$ `, each with what it prints below; `...` stands for anything. A command that
  ends with a comment `# exit code N` ends with N.
- ```` ```python ````: run in the page's one namespace; a block ```` ```output ```` after it is what it prints.
- ```` ```toml ````: a file, if `<!-- file: NAME -->` stands before it; else a part of a study, which is checked.

`<!-- not run: REASON -->` before a block leaves it out, and `<!-- smaller: KEY=VALUE KEY=VALUE -->` sets keys of the studies
that its `gradhesion run` compute, so that they take a moment.
"""

import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]


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


@dataclass(frozen=True)
class Block:
    """A fenced block of a page, with the marks that stand before it."""

    page: Path
    line: int
    language: str
    text: str
    marks: dict[str, str]

    @property
    def place(self) -> str:
        """Where it stands."""
        return f"{self.page.relative_to(ROOT)}:{self.line}"


@dataclass(frozen=True)
class Command:
    """A command of a page."""

    line: str
    printed: str = ""
    code: int = 0


def blocks_of(page: Path) -> list[Block]:
    """List the fenced blocks of a page."""
    text = page.read_text(encoding="utf-8")
    return [
        Block(page, text[: found.start(3)].count("\n"), found[2], found[3], dict(_MARK.findall(found[1])))
        for found in _BLOCK.finditer(text)
    ]


def commands_of(block: Block) -> Iterator[Command]:
    """List the commands of a block."""
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
