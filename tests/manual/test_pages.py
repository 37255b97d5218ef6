"""The manual is whole: it builds, what is generated is up to date, and every command and key stands in it."""

import json
import re
import subprocess
import sys
from pathlib import Path

import click
import nbformat
import pytest

ROOT = Path(__file__).parents[2]
if str(ROOT) not in sys.path:
    sys.path.append(str(ROOT))  # the scripts of the manual are not installed

from docs import notebooks  # noqa: E402
from docs.__main__ import FOLDER, PAGES  # noqa: E402
from gradhesion.cli import errors, main  # noqa: E402
from gradhesion.cli.names.curves import CURVES  # noqa: E402
from gradhesion.cli.names.fits import FIT, FIT_POINTS  # noqa: E402
from gradhesion.cli.names.outputs import OUTPUTS  # noqa: E402
from gradhesion.cli.study.rules.form import Form  # noqa: E402
from gradhesion.cli.study.rules.mistakes import tables_of  # noqa: E402
from gradhesion.core import FLAGS  # noqa: E402
from gradhesion.core.problem.inputs import INPUTS  # noqa: E402

SYNONYMS = (
    "young modulus", "colormap", "mont carlo", "afm", "slurm", "tabor", "hysteresi", "indent", "snap", "export", "uncertainti",
    "checkpoint", "cantilev", "spring", "rough", "pull",
)  # fmt: skip
"""Words that a reader types into the search, as it shortens them (stems)."""


@pytest.mark.parametrize("name", PAGES)
def test_a_generated_page_is_up_to_date(name: str) -> None:
    committed = (FOLDER / name).read_text(encoding="utf-8")
    assert committed == PAGES[name]() + "\n", "the program has changed: run `make reference` and commit the pages"


def test_every_command_and_option_stands_in_the_manual() -> None:
    page = (FOLDER / "reference" / "commands.md").read_text(encoding="utf-8")
    for name, command in main.cli.commands.items():
        section = page.partition(f"\n## gradhesion {name}\n")[2].partition("\n## ")[0]
        options = [option for option in command.params if isinstance(option, click.Option) and not option.hidden]
        assert section
        assert all(re.search(rf"`[^`]*{option.opts[-1]}\b[^`]*` \| \w", section) for option in options), name


def test_every_key_output_and_flag_stands_in_the_manual() -> None:
    study, dataset = (
        (FOLDER / "reference" / f"{name}.md").read_text(encoding="utf-8") for name in ("study", "dataset")
    )
    tables = (
        "parameters",
        "physical",
        "profile",
        "loading",
        "toughness",
        "rate",
        "states",
        "optimum",
        "uncertainty",
        "method",
    )
    of_a_fit = ("data", "fit")
    keys = {key for table in tables_of(Form).values() for key in table.model_fields} - {*tables, *of_a_fit}
    assert keys >= {*INPUTS}
    assert all(f"\n| `{key}` |" in study for key in keys)
    assert all(f"\n## [{name}]\n" in study for name in tables)
    assert all(f"\n### [{name}]\n" in study for name in of_a_fit)
    assert all(f"| `{name}` |" in dataset for name in (*FIT, *(name for own in FIT_POINTS.values() for name in own)))
    assert all(f"| `{name}` |" in dataset for name in (*INPUTS, *OUTPUTS, *FLAGS, *CURVES))
    assert all(f"| `{name}` |" in dataset for own in CURVES.values() for name in own)


def test_exit_codes_are_those_of_the_errors() -> None:
    classes = [one for one in vars(errors).values() if isinstance(one, type) and one is not errors.GradhesionError]
    codes = {one.exit_code for one in classes if issubclass(one, errors.GradhesionError)}
    assert set(errors.EXIT_CODES) == codes | {0, main.INTERRUPTED, main.UNHEARD}


@pytest.mark.slow
def test_the_manual_builds_without_a_warning_and_loads_nothing_from_elsewhere(tmp_path: Path) -> None:
    sphinx = [sys.executable, "-m", "sphinx", "-E", "-q", "-W", "--keep-going", "-d", tmp_path / "trees"]
    done = subprocess.run([*sphinx, ROOT / "docs", tmp_path / "html"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    pages = sorted((tmp_path / "html").rglob("*.html"))
    assert {page.stem for page in pages} >= {page.stem for page in (ROOT / "docs").rglob("*.md")}
    loaded = re.compile(r"<(?:script|img|link|iframe)\b[^>]*\b(?:src|href)=\"(https?:)?//", re.IGNORECASE)
    assert not [page.name for page in pages if loaded.search(page.read_text(encoding="utf-8"))]
    assert "<math" in (tmp_path / "html" / "theory.html").read_text(encoding="utf-8")
    static = tmp_path / "html" / "_static"
    assert (static / "STIXTwoMath-Regular.ttf").stat().st_size > 100_000, "a font for formulae comes along"
    assert "STIXTwoMath-Regular.ttf" in (static / "manual.css").read_text(encoding="utf-8")
    assert "copybutton.js" in (tmp_path / "html" / "units.html").read_text(encoding="utf-8")
    for page in notebooks.PAGES:
        address = f"notebooks/{page}.ipynb"
        assert f'href="{address}"' in (tmp_path / "html" / f"{page}.html").read_text(encoding="utf-8")
        assert (tmp_path / "html" / address).is_file()
    index = (tmp_path / "html" / "searchindex.js").read_text(encoding="utf-8")
    terms = json.loads(index.partition("(")[2].rpartition(")")[0])["terms"]
    for words in SYNONYMS:
        assert all(any(term.startswith(word) for term in terms) for word in words.split()), words


@pytest.mark.parametrize("page", notebooks.PAGES)
def test_a_notebook_has_the_python_of_its_page_and_is_valid(page: str) -> None:
    made = nbformat.reads(notebooks.notebook(page), as_version=4)
    nbformat.validate(made)
    blocks = re.findall(
        r"^```python\n(.*?)^```$", (FOLDER / f"{page}.md").read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )
    assert [cell.source.strip() for cell in made.cells if cell.cell_type == "code"] == [
        block.strip() for block in blocks
    ]
    text = "\n".join(cell.source for cell in made.cells if cell.cell_type == "markdown")
    assert ".md" not in text, "a notebook on its own reaches no other page"
    assert notebooks.notebook(page) == notebooks.notebook(page)


@pytest.mark.slow
@pytest.mark.parametrize("page", notebooks.PAGES)
def test_a_notebook_runs_from_its_first_cell_to_its_last(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    namespace: dict[str, object] = {}
    for cell in nbformat.reads(notebooks.notebook(page), as_version=4).cells:
        if cell.cell_type == "code":
            exec(compile(cell.source, f"{page}.ipynb", "exec"), namespace)  # noqa: S102 (our own text)


def test_every_page_is_in_the_table_of_contents() -> None:
    index = (ROOT / "docs" / "index.md").read_text(encoding="utf-8")
    trees = re.findall(r"```{toctree}(.*?)```", index, flags=re.DOTALL)
    listed = {line.strip() for tree in trees for line in tree.splitlines()}
    pages = {str(page.relative_to(ROOT / "docs").with_suffix("")) for page in (ROOT / "docs").rglob("*.md")}
    assert pages - {"index"} <= listed
