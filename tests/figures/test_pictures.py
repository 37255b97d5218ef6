"""Every picture is drawn from a small dataset of its study; `make` knows the same pictures and studies."""

import re
import struct
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import xarray
from matplotlib.figure import Figure
from matplotlib.text import Annotation

from figures.__main__ import PICTURES, draw, figure_of, main
from figures.fig3 import corners_of
from figures.style import styled
from tests.conftest import ROOT

pytestmark = pytest.mark.slow

Compute = Callable[..., xarray.Dataset]
STUDIES = {path.stem for pattern in ("fig*", "extra_*") for path in (ROOT / "configs").glob(f"{pattern}.toml")}
REFUSED = {"x.nc": "not a dataset that fig3a is drawn from (", "none.nc": "no such file"}


def study_of(picture: str) -> str:
    return picture if picture in STUDIES else picture[:-1]


def drawn(name: str, dataset: xarray.Dataset) -> Figure:
    with styled():
        return figure_of(name, dataset)


@pytest.mark.parametrize("name", PICTURES)
def test_every_picture_is_drawn_and_its_axes_are_named(name: str, computed: Compute, tmp_path: Path) -> None:
    dataset = computed(study_of(name))
    draw(name, dataset, [tmp_path / "a.png"], dpi=50)
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    for axes in drawn(name, dataset).axes if name != "fig1" else ():  # a section has no axes
        assert "$" in axes.get_xlabel()
        assert "$" in axes.get_ylabel() or axes.get_ylabel() == "greatest force over the wavelength"
        assert axes.lines or axes.collections


def test_every_study_has_a_picture_and_every_picture_a_study() -> None:
    assert {study_of(name) for name in PICTURES} == STUDIES != set()


def test_a_picture_has_every_form_and_the_resolution_that_is_named(computed: Compute, tmp_path: Path) -> None:
    """And is twice the same."""
    files = [tmp_path / "a.png", tmp_path / "c.png", tmp_path / "b.pdf"]
    for dpi, pixels, forms in ((None, (1005, 780), 3), (120, (402, 312), 2)):
        draw("fig8", computed("fig8"), files[:forms], dpi=dpi)
        assert files[2].read_bytes().startswith(b"%PDF")
        assert files[0].read_bytes() == files[1].read_bytes()
        assert struct.unpack(">II", files[0].read_bytes()[16:24]) == pixels  # 3.35 x 2.6 inches


def test_make_draws_every_picture_from_its_study_and_the_page_shows_it() -> None:
    make = ["make", "-nB", "figures", "docs-figures"]
    made = subprocess.run(make, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    page = (ROOT / "docs" / "paper.md").read_text()
    for name in PICTURES:
        study, path = study_of(name), f"outputs/figures/{name}"
        assert f"run configs/{study}.toml -o outputs/figures/{study}.nc" in made
        assert f"-m figures {name} outputs/figures/{study}.nc {path}.png" in made
        assert f"(figures/paper/{name}.png)" in page
    for folder in ("outputs/figures", "docs/figures/paper"):
        assert set(re.findall(rf" {folder}/(\w+)\.png", made)) == set(PICTURES)
    assert {path.stem for path in (ROOT / "docs" / "figures" / "paper").glob("*.png")} == set(PICTURES)


def test_the_command_line_draws_or_refuses_in_one_sentence(
    computed: Compute, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    computed("fig8").to_netcdf(tmp_path / "x.nc")
    picture = tmp_path / "new" / "x.svg"
    for file, words in REFUSED.items():
        monkeypatch.setattr(sys, "argv", ["figures", "fig3a", str(tmp_path / file), str(picture)])
        with pytest.raises(SystemExit, match=r"^2$"):
            main()
        told = capsys.readouterr().err
        assert told.count("\n") == 1
        assert words in told
        assert "write it with `gradhesion run configs/fig3.toml`" in told
        assert not picture.exists()
    monkeypatch.setattr(sys, "argv", ["figures", "fig8", str(tmp_path / "x.nc"), str(picture)])
    main()
    assert b"<svg" in picture.read_bytes()


def test_the_corners_of_the_path_are_named_from_a_to_l(computed: Compute) -> None:
    dataset = computed("fig3")
    assert len(corners_of(dataset)) == 12
    for plane in "abc":
        (axes,) = drawn(f"fig3{plane}", dataset).axes
        names = [text.get_text() for text in axes.texts if isinstance(text, Annotation) and text.get_text()]
        assert "".join(names) == "ABCDEFGHIJKL"
