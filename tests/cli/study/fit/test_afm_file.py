"""Files of instruments: heights, forces and segments become depth, load and branches by the conventions of the field."""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gradhesion as gr
from tests.cli.conftest import COLUMNS
from tests.cli.study.fit.test_fit_data import DEPTH, FORCE, STUDY, load, points, refused

afmformats = pytest.importorskip("afmformats")

SPRING = 2.5
PLAIN = STUDY.replace(COLUMNS, "")


def saved(folder: Path, name: str, *leave_out: str, curves: int = 1, spring: float | None = SPRING) -> dict[str, Any]:
    """Save points as the base of a cantilever would have moved, with a pause; give their depth, load and branch."""
    import h5py
    from afmformats.mod_force_distance import AFMForceDistance

    rows = points(600)
    depth, load = 1e-9 * rows["depth"], 1e-9 * rows["force"]
    segment = np.where(rows["back"], 1, 0).astype(np.uint8)
    segment[290:310] = 2
    columns = {"height (measured)": 3e-6 - (depth + load / SPRING), "force": load, "tip position": 3e-6 - depth}
    columns |= {"segment": segment, "time": np.arange(600) * 1e-3}
    data = {key: values for key, values in columns.items() if key not in leave_out}
    known = {} if spring is None else {"spring constant": spring}
    meta = {"path": name, "imaging mode": "force-distance", "point count": 600, **known}
    made = [AFMForceDistance(data, meta | {"enum": i}) for i in range(curves)]
    if name.endswith(".tab"):
        made[0].export_data(folder / name, fmt="tab")
    else:
        with h5py.File(folder / name, "w") as file:
            for curve in made:
                curve.export_data(file, fmt="hdf5")
    kept = segment < 2
    return {"depth": depth[kept], "load": load[kept], "back": rows["back"][kept]}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "fit.toml").write_text(PLAIN)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("name", ["curve.h5", "curve.tab"])
@pytest.mark.parametrize("leave_out", [(), ("tip position",)])
def test_depth_is_the_displacement_less_the_deflection(folder: Path, name: str, leave_out: tuple[str, ...]) -> None:
    rows = saved(folder, name, *leave_out)
    study = load(data__file=name)
    loop = study.loop
    np.testing.assert_allclose(loop.depth, rows["depth"] - 3e-6, rtol=0, atol=1e-12)
    np.testing.assert_allclose(loop.load, rows["load"], rtol=1e-6, atol=1e-14)
    np.testing.assert_array_equal(loop.unloading, rows["back"])
    assert loop.paused == 20
    assert any(f"{name}: 20 rows" in note for note in study.notes)


def test_through_the_machine_the_height_is_its_displacement(folder: Path) -> None:
    rows = saved(folder, "curve.h5")
    study = load(data__file="curve.h5", loading__control="machine", physical__spring_constant="2.5 N/m")
    np.testing.assert_allclose(study.loop.depth, rows["depth"] + rows["load"] / SPRING - 3e-6, rtol=0, atol=1e-12)
    refused("physical.spring_constant", data__file="curve.h5", loading__control="machine")


def test_columns_may_be_named_with_their_sign(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a file that only an instrument writes: a file of afmformats under its name."""
    rows = saved(folder, "saved.h5")
    (folder / "curve.jpk-force").write_text("JPK")
    refused("data.file", data__file="curve.jpk-force")
    real = afmformats.load_data
    monkeypatch.setattr(afmformats, "load_data", lambda _, **more: real(folder / "saved.h5", **more))
    height, spring = {"column": "height (measured)", "sign": -1}, {"physical__spring_constant": "2.5 N/m"}
    study = load(data__file="curve.jpk-force", data__displacement=height, data__load="force", **spring)
    np.testing.assert_allclose(study.loop.depth, rows["depth"] + rows["load"] / SPRING - 3e-6, rtol=0, atol=1e-12)
    refused("data.indentation", data__file="curve.jpk-force", data__indentation="hight", data__load="force")
    wrong = {"column": "force", "unit": "nN"}
    refused("data.load", data__file="curve.jpk-force", data__load=wrong, data__indentation="tip position")


def test_each_curve_of_a_file_is_a_loop(folder: Path) -> None:
    saved(folder, "map.h5", curves=3)
    study = load(data__file="map.h5")
    assert [loop.file for loop in study.loops] == ["map.h5#0", "map.h5#1", "map.h5#2"]
    assert not study.is_of_one
    (folder / "stored.toml").write_text(study.text)
    assert gr.load("stored.toml").text == study.text


def test_what_a_file_lacks_is_said(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    saved(folder, "a.h5", "tip position", spring=None)
    saved(folder, "b.h5", "force")
    saved(folder, "c.h5", "tip position", "height (measured)")
    (folder / "d.ibw").write_text("no wave")
    for name in ("a.h5", "b.h5", "c.h5", "d.ibw", "e.ibw"):
        refused("data.file", data__file=name)
    assert capfd.readouterr().err == "", "no traceback of another package"


def test_tables_by_such_names_are_tables_where_columns_are_named(folder: Path) -> None:
    (folder / "loop.tab").write_text("depth\tforce\n" + "".join(f"{i % 9}\t{i % 7}\n" for i in range(20)))
    assert load(data__file="loop.tab", data__indentation=DEPTH, data__load=FORCE).loop.depth.size == 20
    refused("data.indentation", "data.load", data__file="loop.csv")


def test_without_the_package_its_name_is_said(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    saved(folder, "curve.h5")
    monkeypatch.setitem(sys.modules, "afmformats", None)
    assert "pip install gradhesion[afm]" in refused("data.file", data__file="curve.h5")
