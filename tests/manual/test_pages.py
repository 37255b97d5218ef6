"""The manual is whole: it builds, and every command and key stands in it."""

import re
import subprocess
import sys
from pathlib import Path

import click
import pytest

import gradhesion as gr
from docs.generated import PAGES
from gradhesion.cli import errors, main
from gradhesion.cli.names.curves import CURVES
from gradhesion.cli.names.fits import FIT, FIT_POINTS
from gradhesion.cli.names.outputs import OUTPUTS
from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.rules.mistakes import tables_of
from gradhesion.core import FLAGS
from gradhesion.core.problem.inputs import INPUTS
from tests.conftest import ROOT


def test_every_command_and_option_stands_in_the_manual() -> None:
    page = PAGES["commands"]()
    for name, command in main.cli.commands.items():
        section = page.partition(f"\n## gradhesion {name}\n")[2].partition("\n## ")[0]
        options = [option for option in command.params if isinstance(option, click.Option) and not option.hidden]
        assert section
        assert all(re.search(rf"`[^`]*{option.opts[-1]}\b[^`]*` \| \w", section) for option in options), name


def test_every_key_output_and_flag_stands_in_the_manual() -> None:
    study, dataset = PAGES["study"](), PAGES["dataset"]()
    tables = ("parameters", "physical", "profile", "loading", "toughness", "rate", "states", "optimum", "uncertainty", "method")  # fmt: skip
    of_a_fit = ("data", "fit")
    keys = {key for table in tables_of(Form).values() for key in table.model_fields} - {*tables, *of_a_fit}
    assert keys >= {*INPUTS}
    assert all(f"\n| `{key}` |" in study for key in keys)
    assert all(f"\n## [{name}]\n" in study for name in tables)
    assert all(f"\n### [{name}]\n" in study for name in of_a_fit)
    assert all(f"| `{name}` |" in dataset for name in (*FIT, *(name for own in FIT_POINTS.values() for name in own)))
    assert all(f"| `{name}` |" in dataset for name in (*INPUTS, *OUTPUTS, *FLAGS, *CURVES))
    assert all(f"| `{name}` |" in dataset for own in CURVES.values() for name in own)


def test_every_name_of_the_package_stands_in_the_manual() -> None:
    page = PAGES["python"]()
    assert all(f"### gr.{name}\n" in page or f"`gr.{name}`" in page for name in gr.__all__)


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
    assert {page.stem for page in pages} >= {page.stem for page in (ROOT / "docs").glob("*.md")} | {*PAGES}
    loaded = re.compile(r"<(?:script|img|link|iframe)\b[^>]*\b(?:src|href)=\"(https?:)?//", re.IGNORECASE)
    assert not [page.name for page in pages if loaded.search(page.read_text(encoding="utf-8"))]
    assert "<math" in (tmp_path / "html" / "theory.html").read_text(encoding="utf-8")
    static = tmp_path / "html" / "_static"
    assert (static / "STIXTwoMath-Regular.ttf").stat().st_size > 100_000, "a font for formulae comes along"
    assert "STIXTwoMath-Regular.ttf" in (static / "manual.css").read_text(encoding="utf-8")
    assert "copybutton.js" in (tmp_path / "html" / "scenes.html").read_text(encoding="utf-8")


def test_every_link_of_a_file_that_is_read_in_the_repository_is_there() -> None:
    """A link to a generated page holds where the manual is built; from elsewhere only files of the repository are named."""
    generated = {ROOT / "docs" / "reference" / f"{name}.md" for name in PAGES}
    pages = [*(ROOT / "docs").glob("*.md"), ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
    for page in pages:
        allowed = generated if page.parent.name == "docs" else set()
        for link in re.findall(r"\]\((?!https?:|#)([^)#\s]+)", page.read_text(encoding="utf-8")):
            path = (page.parent / link).resolve()
            assert path in allowed or (path not in generated and path.exists()), f"{page.name}: {link}"


def test_every_page_that_the_sources_name_is_there() -> None:
    tops = ("api", "benchmarks", "cli", "configs", "core", "docs", "figures", "tests", "twin")
    files = [file for top in tops for ending in ("py", "toml") for file in (ROOT / top).rglob(f"*.{ending}")]
    for file in (*files, ROOT / "Makefile", ROOT / "pyproject.toml", ROOT / "CHANGELOG.md"):
        for page in re.findall(r"\bdocs/[\w/]+\.md\b", file.read_text(encoding="utf-8")):
            assert (ROOT / page).is_file(), f"{file.relative_to(ROOT)}: {page}"
