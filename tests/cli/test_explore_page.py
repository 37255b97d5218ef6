"""The page of `gradhesion explore` in a real browser: what it shows is what the dataset has."""

import csv
import os
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from bokeh.palettes import Viridis256
from playwright.sync_api import Browser, Page, sync_playwright

import gradhesion as gr
from tests.cli.browser import TITLE, VALUES, Opened, number, same, written

pytestmark = pytest.mark.slow

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
AXES = ("k", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")
FRAMES = """[...explorer.parts.maps, ...explorer.parts.sections.flatMap((both) => Object.values(both))].map((part) => {
    const view = Bokeh.index.find_one(part.figure), box = view.canvas_view.el.getBoundingClientRect()
    return [box.left + view.frame.bbox.left, box.left + view.frame.bbox.right]
})"""
"""Of two maps, and of the two sections of each."""


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        told = "no browser is installed: chromium, as `apt-get install chromium` installs it, tests the pages"
        assert not {"BROWSER_REQUIRED", "CI"} & os.environ.keys(), told
        pytest.skip(told)
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield running
        running.close()


Open = Callable[..., Opened]


@pytest.fixture(scope="module")
def tab(browser: Browser) -> Page:
    """One tab for all pages: a new one compiles the scripts of Bokeh anew, which takes longer than the rest."""
    return browser.new_page()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("pages")


@pytest.fixture
def open_page(tab: Page, folder: Path) -> Iterator[Open]:
    """Open the page of a study in the tab, where it takes the place of the one before."""
    opened: list[Opened] = []

    def open_one(name: str, address: str = "", size: tuple[int, int] = (1400, 900), tab: Page = tab) -> Opened:
        close()
        tab.set_viewport_size({"width": size[0], "height": size[1]})
        opened.append(Opened(tab, written(name, folder), address))
        return opened[-1]

    def close() -> None:
        while opened:
            opened.pop().closed()

    yield open_one
    close()


def test_the_keys_move_the_sliders_and_the_values_are_those_of_the_dataset(open_page: Open) -> None:
    page = open_page("maps")
    at = {name: (page.dataset.sizes[name] - 1) // 2 for name in AXES}
    page.shows(**at)
    moves = {"a_max_over_R": (["End"], 2), "A": (["ArrowRight"], 2), "c0_over_R": (["ArrowRight", "ArrowRight"], 1), "lambda_over_R": (["Home", "ArrowRight"], 1), "k": (["End"], 3)}  # fmt: skip
    for axis, (keys, place) in moves.items():
        page.press(axis, *keys)
        page.shows(**(at := at | {axis: place}))
        assert page.text("value-status") == "nothing to report"
    assert page.text("axis-a_max_over_R-value") == "unbounded"
    assert page.page.get_attribute("#axis-a_max_over_R", "aria-valuetext") == "unbounded"


def test_a_pointer_reads_cells_and_a_tap_holds_one(open_page: Open) -> None:
    page = open_page("maps")
    waves = np.log10(page.dataset["lambda_over_R"])
    for number_of_map in (0, 1):
        for k, wave in [(0, 0), (3, 6), (1, 5)]:
            page.point(f"explorer.parts.maps[{number_of_map}]", waves[wave], page.dataset["k"][k])
            page.shows(k=k, lambda_over_R=wave, c0_over_R=0, A=1, a_max_over_R=1)
    assert "follows" in page.text("held")
    page.page.mouse.down()
    page.page.mouse.up()
    page.wait_for_text("held", "held")
    page.point("explorer.parts.maps[0]", waves[0], 0.0)
    page.shows(k=1, lambda_over_R=5, c0_over_R=0, A=1, a_max_over_R=1)
    for wave, words in [(2, "contact on loading is not one disc"), (4, "a parameter is outside its range")]:
        page.page.mouse.click(*page.point_of("explorer.parts.maps[1]", float(waves[wave]), 0.0))
        page.wait_for_text("value-status", words)
    assert page.text("value-dissipated_energy") == "no value"


def _colours(page: Opened, i: int) -> Callable[[float, float], list[str]]:
    """Give the colours in the middle of a cell of a map, whose centre is given in parts of the picture."""
    found = f"explorer.parts.maps[{i}].image.data.image[0]"
    pixels = page.js(f"Array.from(new Uint8Array({found}.buffer), one => String.fromCharCode(one)).join('')")
    image = np.frombuffer(pixels.encode("latin-1"), dtype="<u4").reshape(page.js(f"{found}.shape"))

    def colours(row: float, column: float) -> list[str]:
        j, k = int(row * image.shape[0]), int(column * image.shape[1])
        part = np.unique(image[j - 8 : j + 8, k - 8 : k + 8])
        return [f"#{pixel.tobytes()[:3].hex()}" for pixel in part]

    return colours


def test_a_cell_has_the_colour_of_its_value_and_the_marks_of_its_flags(open_page: Open) -> None:
    page = open_page("maps")
    page.press("A", "End")
    assert page.js("document.querySelectorAll('#flags li').length") == 2, "the flag that occurs, and no value"
    values = page.dataset["dissipated_energy"].isel(c0_over_R=0, A=2, a_max_over_R=1).values
    # rows of the picture are cells of k, uneven as its values: 0, 0.31, 0.62, 0.9 with edges half-way between
    rows = (np.array([0.0, 0.31, 0.62, 0.9]) + 0.155) / (1.04 + 0.155)
    for log in (True, False):
        page.page.set_checked("#log-1", log)
        sizes = np.log10(values) if log else values
        part = (sizes - np.nanmin(sizes)) / np.ptp(sizes[np.isfinite(sizes)])
        colours = _colours(page, 1)
        for k, wave in np.ndindex(4, 7):
            found = colours(rows[k], (wave + 0.5) / 7)
            if np.isnan(values[k, wave]):
                assert set(found) == {"#d4d4d4", "#9a9a9a"}
            else:
                assert Viridis256[min(255, int(part[k, wave] * 256))].lower() in found, (log, k, wave)
                assert (len(found) == 2) == (wave == 2), (log, k, wave)
        assert all(len(_colours(page, 0)(row, 2.5 / 7)) == 1 for row in rows), "no doubt about the force"
    page.page.set_checked("#flag-0", False)
    assert len(_colours(page, 1)(rows[1], 2.5 / 7)) == 1


def test_other_axes_and_variables_are_chosen(open_page: Open) -> None:
    page = open_page("maps")
    assert (page.page.title(), page.js("window.broken")) == (TITLE, None)
    page.page.select_option("#along-x", label="A – amplitude over wavelength of the waviness")
    page.page.select_option("#along-y", label="λ/R – wavelength of the waviness")
    page.page.select_option("#shown-1", label="jumps on loading")
    figures = "explorer.parts.maps.map(map => map.figure)"
    labels = page.js(f"{figures}.map(one => [one.below[0].axis_label, one.left[0].axis_label])")
    assert labels == [["A", "λ/R"]] * 2, "what was across is up now, and what was up is free"
    assert page.js(f"{figures}[0].x_range === {figures}[1].x_range")
    page.point("explorer.parts.maps[1]", 0.05, np.log10(page.dataset["lambda_over_R"][6]))
    scene = page.shows(k=1, c0_over_R=0, lambda_over_R=6, A=2, a_max_over_R=1)
    assert same(page.text("now-1"), float(scene["loading_jumps"]))
    page.page.set_checked("#log-1", False)
    jumps = page.dataset["loading_jumps"].isel(k=1, c0_over_R=0, a_max_over_R=1)
    for side, values in (("x", jumps.isel(lambda_over_R=6)), ("y", jumps.isel(A=2))):
        drawn = page.js(f"Array.from(explorer.parts.sections[1].{side}.lines.data.ys[0])")
        assert drawn == values.values.tolist(), "the sections are the row and the column of the cell"


def test_on_a_phone_there_is_one_column_and_a_finger_reads_a_cell(open_page: Open, browser: Browser) -> None:
    page = open_page("maps", size=(390, 844), tab=browser.new_page(has_touch=True))
    first, second = page.boxes(".plot.map")
    assert first["left"] == second["left"]
    assert second["top"] > first["bottom"]
    for axis in AXES:
        page.js(f"document.getElementById('axis-{axis}').scrollIntoView({{block: 'center'}})")
        first, (slider,) = page.boxes(".plot.map")[0], page.boxes(f"#axis-{axis}")
        assert -1 <= first["top"] < first["bottom"] <= slider["top"] + 1, "the map stays in view"
    place = np.log10(float(page.dataset["lambda_over_R"][1])), 0.9
    page.page.touchscreen.tap(*page.point_of("explorer.parts.maps[0]", *place))
    page.wait_for_text("held", "held")
    page.shows(k=3, c0_over_R=0, lambda_over_R=1, A=1, a_max_over_R=1)


@pytest.mark.parametrize("width", [360, 1920])
def test_the_page_is_used_frames_stand_in_line_and_everything_has_a_label(width: int, open_page: Open) -> None:
    page = open_page("maps", size=(width, 900))
    assert page.js("document.documentElement.scrollWidth <= window.innerWidth")
    frames = np.array(page.js(FRAMES))
    np.testing.assert_allclose(frames[2:], frames[[0, 0, 1, 1]], rtol=0, atol=1.5)
    assert max(box["right"] for box in page.boxes(".plot.map")) > 0.95 * width, "no part of a wide window is empty"
    assert page.page.get_attribute("html", "lang") == "en"
    assert page.js("[...document.querySelectorAll('main input, main select')].every(one => one.labels.length)")
    assert page.page.locator(".plot:not([aria-label])").count() == 0
    page.page.click("summary >> nth=0")
    assert "[parameters]" in page.page.inner_text("details >> nth=0")


def test_lines_are_those_of_all_solvers_and_points_are_dots_over_a_parameter(open_page: Open) -> None:
    page = open_page("lines")
    page.press("solver", "End")
    page.point("explorer.parts.sections[1].x", np.log10(0.47), 0.0)
    page.shows(solver=1, lambda_over_R=2)  # held by the key: the pointer does not move it
    assert page.text("value-solver") == "envelope"
    page.page.set_checked("#log-0", False)
    drawn = page.js("explorer.parts.sections[0].x.lines.data.ys.map(line => Array.from(line))")
    np.testing.assert_allclose(drawn, page.dataset["pull_off_force"], rtol=5e-6)  # six digits
    assert page.text("lines").split() == ["exact", "envelope"]
    page = open_page("rough")
    page.press("realisation", "End")
    page.shows(realisation=4, lambda_over_R=0)
    page = open_page("points")
    page.page.select_option("#along-x", label="λ/R – wavelength of the waviness")
    page.page.set_checked("#log-0", False)
    dot = page.dataset.isel(scene=2)
    page.point("explorer.parts.sections[0].x", np.log10(dot["lambda_over_R"]), dot["pull_off_force"])
    page.shows(scene=2)


@pytest.mark.parametrize("units", [{}, {"indentation": 1e-9, "contact_radius": 1e-9, "load": 1e-6}])
def test_curves_are_those_of_the_scene_and_can_be_hidden(units: dict[str, float], open_page: Open) -> None:
    page = open_page("curves in units" if units else "curves")
    for axis in ("A", "k"):
        page.press(axis, "End")
    scene = page.dataset.isel(A=2, k=1)
    si = "_si" if units else ""
    for i, sides in enumerate([("indentation", "load"), ("contact_radius", "indentation"), ("contact_radius", "load")]):
        lines = page.js(f"explorer.parts.planes[{i}].lines.data")
        for side, quantity in zip(("xs", "ys"), sides, strict=True):
            drawn = np.concatenate(lines[side])
            expected = np.concatenate([scene[f"{part}{quantity}{si}"] for part in ("", "path_")])
            ends = np.array([np.nanmin(expected), np.nanmax(expected)]) / units.get(quantity, 1)
            np.testing.assert_allclose([drawn.min(), drawn.max()], ends, rtol=5e-6)
    lines = page.js("explorer.parts.planes[0].lines.data")
    assert lines["width"].count(page.js("explorer.study.tracks[0].jumpWidth")) == int(scene["path_jump"].sum())
    label = page.js("explorer.parts.planes[0].figure.left[0].axis_label")
    assert label == ("load P (µN)" if units else "load P/(1.5 πRΔγ)")
    assert page.page.locator(f"#value-path_load{si}").count() == 0
    tracks = {track["label"]: track for track in page.js("explorer.study.tracks")}
    unloading = tracks["unloading"]
    assert unloading["colour"] in lines["colour"]
    page.page.set_checked(f"#track-{[*tracks].index('unloading')}", False)
    assert unloading["colour"] not in page.js("explorer.parts.planes[0].lines.data.colour"), "loading alone is left"
    assert len(unloading["dash"]) > 0 == len(tracks["loading"]["dash"]), "loading shows in the gaps of unloading"


def test_the_address_brings_a_colleague_to_the_same_state(open_page: Open) -> None:
    page = open_page("maps")
    page.press("A", "End")
    page.press("k", "Home")
    page.page.set_checked("#log-0", False)
    page.page.select_option("#along-y", label="A – amplitude over wavelength of the waviness")
    page.page.select_option("#shown-1", label="jumps on loading")
    page.page.wait_for_function("location.hash.includes('loading_jumps')")
    state = "[explorer.at, explorer.x, explorer.y, explorer.drawn, explorer.held]"
    kept, along_y, address = page.js(state), page.page.input_value("#along-y"), page.page.url.partition("#")[2]
    there = open_page("maps", f"#{address}")
    assert there.js(state) == kept
    assert there.page.input_value("#along-y") == along_y
    assert there.page.is_hidden("#wrong")


def test_what_an_address_has_not_is_said_and_the_rest_is_taken(open_page: Open) -> None:
    wrong = open_page("maps", "#k=many&A=0.0231&x=x&show=nothing&log=,,")
    assert wrong.text("value-A") == "0.023"
    assert wrong.js("explorer.x !== explorer.y")
    assert [key for key in ("k", "A", "x", "nothing") if not re.search(rf"\b{key}\b", wrong.text("wrong"))] == []
    other = open_page("maps", "#k=0.62&A=0&lamda_over_R=0.2&a_max_over_R=inf")
    assert [other.text(f"value-{name}") for name in ("k", "A", "a_max_over_R")] == ["0.62", "0", "unbounded"]
    assert "lamda_over_R" in other.text("wrong")
    assert open_page("maps", "#%zz=1&k=%").page.is_visible("#wrong")


@pytest.mark.parametrize(("name", "value"), [("maps", "dissipated_energy"), ("machine", "pull_off_force_si")])
def test_a_downloaded_study_and_script_give_the_scene(name: str, value: str, open_page: Open, tmp_path: Path) -> None:
    page, at = open_page(name), {"A": 2, "a_max_over_R": 2} if name == "maps" else {"R": 2}
    for axis in at:
        page.press(axis, "End")
    scene = page.dataset.isel({axis: (size - 1) // 2 for axis, size in page.dataset.sizes.items()} | at)
    (tmp_path / "scene.toml").write_bytes(page.download("toml"))
    called: dict[str, Any] = {}
    exec(page.download("py"), called)  # noqa: S102 (what the page wrote)
    for found in (gr.run(tmp_path / "scene.toml"), called["scene"]):
        assert float(found[value]) == pytest.approx(float(scene[value]), rel=1e-11)
        assert found.attrs["profile"] == page.dataset.attrs["profile"]


def test_a_table_that_is_downloaded_is_the_map_that_is_shown(open_page: Open) -> None:
    page = open_page("maps")
    page.press("A", "End")
    rows = list(csv.DictReader(page.download("csv").decode().splitlines()))
    shown = page.dataset.isel(c0_over_R=0, A=2, a_max_over_R=1)
    assert len(rows) == shown.sizes["k"] * shown.sizes["lambda_over_R"]
    for row in rows:
        assert float(row["A"]) == 0.05
        own = shown.sel({name: float(row[name]) for name in ("k", "lambda_over_R")}, method="nearest")
        for name in (*VALUES, "loading_jumps"):
            wanted = float(own[name])
            assert row[name] == "" if np.isnan(wanted) else float(row[name]) == float(f"{wanted:.6g}")


def test_sensitivities_are_those_under_the_pointer_and_the_strongest_is_marked(open_page: Open) -> None:
    page = open_page("sensitivities")
    for place in (0, 4):
        page.point("explorer.parts.maps[0]", page.dataset["lambda_over_R"][place], 0.3)
        scene = page.dataset.isel(k=1, lambda_over_R=place)
        for output in (f"{name}_sensitivity" for name in VALUES):
            values = {str(name): scene[output].sel(parameter=name).item() for name in scene["parameter"].values}
            for name, value in values.items():
                assert number(page.text(f"value-{output}_{name}")) == pytest.approx(value, rel=5.1e-4, abs=1e-12), name
            sizes = {name: abs(value) for name, value in values.items() if name not in ("k", "nu")}
            marked = page.js(f"[...document.querySelectorAll('[id^=value-{output}_].strongest')].map(one => one.id)")
            assert marked == [f"value-{output}_{max(sizes, key=sizes.__getitem__)}"]
