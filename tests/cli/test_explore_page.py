"""The page of `gradhesion explore` in a real browser: what it shows is what the dataset has."""

import csv
import os
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from bokeh.palettes import Viridis256
from click.testing import CliRunner
from playwright.sync_api import Browser, Page, sync_playwright

import gradhesion as gr
from gradhesion.cli.main import cli

pytestmark = pytest.mark.slow

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
STUDY = """
title = "Maps </script><script>window.broken = 1</script> & more"
outputs = ["pull_off_force", "dissipated_energy", "loading_jumps"]
[parameters]
k = [0.0, 0.31, 0.62, 0.9]
nu = 0.27
modulus = 430.0
c0_over_R = [0.013, 0.2]
lambda_over_R = { start = 0.11, stop = 0.87, num = 7, spacing = "log" }
A = [0.0, 0.023, 0.05]
a_max_over_R = [0.3, 1.7, inf]
"""
LINES = """
title = "Lines"
outputs = ["pull_off_force", "dissipated_energy"]
method = { solver = ["exact", "envelope"] }
[parameters]
k = 0.3
nu = 0.27
modulus = 430.0
c0_over_R = 0.013
lambda_over_R = { start = 0.11, stop = 0.47, num = 5, spacing = "log" }
A = 0.023
a_max_over_R = 1.7
"""
POINTS = """
title = "Points"
layout = "points"
outputs = ["pull_off_force", "dissipated_energy"]
[parameters]
k = [0.1, 0.5, 0.2, 0.4]
nu = 0.27
modulus = 430.0
c0_over_R = 0.013
lambda_over_R = [0.11, 0.3, 0.7, 0.2]
A = 0.023
a_max_over_R = inf
"""
CURVES = """
title = "Curves"
kind = "curve"
outputs = ["equilibrium", "path"]
[parameters]
k = [0.1, 0.3]
nu = 0.27
modulus = 430.0
c0_over_R = 0.013
lambda_over_R = 0.17
A = [0.0, 0.023, 0.07]
a_max_over_R = 0.4
"""

CURVES_IN_UNITS = """
title = "Curves in units"
kind = "curve"
outputs = ["equilibrium", "path"]
[parameters]
k = 0.3
nu = 0.27
A = [0.0, 0.07]
[physical]
R = "1 um"
E_star = "1 GPa"
work_of_adhesion = "50 mJ/m^2"
c0 = "13 nm"
wavelength = "0.2 um"
a_max = "0.4 um"
"""

MACHINE = """
title = "A machine in units"
outputs = ["pull_off_force"]
[parameters]
k = 0.3
nu = 0.27
A = 0.03
[physical]
R = ["1 um", "2 um", "3 um"]
E_star = "1 GPa"
work_of_adhesion = "50 mJ/m^2"
c0 = "13 nm"
wavelength = "0.2 um"
a_max = "0.4 um"
spring_constant = "2 N/m"
[profile]
exponent = 2.0
harmonics = [{ n = 1, cos = 1.0 }, { n = 2, cos = 0.2 }]
[loading]
control = "machine"
"""


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        assert not {"BROWSER_REQUIRED", "CI"} & os.environ.keys(), (
            "no browser: install chromium, as `apt-get install chromium` does"
        )
        pytest.skip("no browser is installed: chromium, as `apt-get install chromium` installs it, tests the pages")
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield running
        running.close()


def _made(folder: Path, study: str, edit: Callable[[netCDF4.Dataset], None] | None = None) -> Path:
    """Make a dataset and its page in a folder."""
    (folder / "study.toml").write_text(study)
    for arguments in (["run", "study.toml", "-o", "data.nc", "--quiet"], ["explore", "data.nc"]):
        if edit is not None and arguments[0] == "explore":
            with netCDF4.Dataset(folder / "data.nc", "a") as file:
                edit(file)
        names = [str(folder / argument) if "." in argument else argument for argument in arguments]
        result = CliRunner().invoke(cli, names)
        assert result.exit_code == 0, result.output
    return folder / "data.html"


def _spoil(file: netCDF4.Dataset) -> None:
    """Give one column of the first map a flag, and one cell no value."""
    status = file["status"][:]
    status[:] = 0
    status[:, :, 2] = 1  # contact on loading is not one disc: a doubt about the energy, not about the force
    status[0, :, 4] = 64
    file["status"][:] = status
    for name in ("pull_off_force", "dissipated_energy"):
        values = file[name][:]
        values[0, :, 4] = np.nan
        file[name][:] = values


@pytest.fixture(scope="module")
def maps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return _made(tmp_path_factory.mktemp("maps"), STUDY, _spoil)


class Opened:
    """A page in a tab, with what it asked for and what it complained of."""

    def __init__(self, browser: Browser, file: Path, address: str = "", **options: Any) -> None:
        self.page: Page = browser.new_page(**{"viewport": {"width": 1400, "height": 900}, **options})
        self.page.set_default_timeout(120_000)  # a busy machine
        self.requests: list[str] = []
        self.complaints: list[str] = []
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on(
            "console", lambda told: self.complaints.append(told.text) if told.type in {"warning", "error"} else None
        )
        self.page.goto(file.as_uri() + address)
        self.page.wait_for_selector("html[data-ready=true]", state="attached")
        self.settle()

    def settle(self) -> None:
        """Wait until the page has drawn what it was asked for."""
        self.page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def shown(self, name: str) -> str:
        """Read a value from the table of the scene."""
        self.settle()
        return self.page.inner_text(f"#value-{name}")

    def press(self, axis: str, *keys: str) -> None:
        """Move the slider of an axis by keys."""
        self.page.focus(f"#axis-{axis}")
        for key in keys:
            self.page.keyboard.press(key)
        self.settle()

    def point_of(self, part: str, x: float, y: float) -> tuple[float, float]:
        """Find the point in the window at a place in a figure."""
        self.page.evaluate(f"window.view = Bokeh.index.find_one({part}.figure); null")
        self.page.evaluate("view.el.scrollIntoView({block: 'center'})")
        left, top = self.page.evaluate(
            "(([x, y]) => { const box = view.canvas_view.el.getBoundingClientRect();"
            "return [box.left + view.frame.x_scale.compute(x), box.top + view.frame.y_scale.compute(y)] })"
            f"([{x}, {y}])"
        )
        return float(left), float(top)


@pytest.fixture
def open_page(browser: Browser) -> Iterator[Callable[..., Opened]]:
    """Open pages; each must need nothing else, and complain of nothing."""
    opened: list[Opened] = []

    def open_one(file: Path, address: str = "", **options: Any) -> Opened:
        opened.append(Opened(browser, file, address, **options))
        return opened[-1]

    yield open_one
    for one in opened:
        assert [url[:60] for url in one.requests if not url.startswith(("file:", "data:", "blob:"))] == []
        assert len([url for url in one.requests if url.startswith("file:")]) == 1
        assert one.complaints == []
        one.page.close()


def number(text: str) -> float:
    """Read a number as the page writes it."""
    if text in {"∞", "unbounded", "no value"}:
        return np.nan if text == "no value" else np.inf
    plain = text.translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--"))
    return float(
        re.sub(r"^(10)(?=-?\d)", "1×10", plain).replace("×10", "e") if "10" in plain and text != plain else plain
    )


def same(text: str, value: float) -> bool:
    """Tell whether a text is a value to six digits."""
    return np.array_equal(number(text), float(f"{value:.6g}"), equal_nan=True)


APART = ("status", "steep_contact")
"""What the page says in words."""


def scenes_shown(page: Opened, scene: xarray.Dataset) -> None:
    """Compare all that the table has of a scene with the dataset."""
    page.settle()
    rows = page.page.evaluate("[...document.querySelectorAll('td[id]')].map(cell => [cell.id, cell.textContent])")
    shown = {name.removeprefix("value-"): text for name, text in rows}
    expected = {str(name): float(scene[name]) for name in (*scene.data_vars, *scene.coords) if name not in APART}
    assert expected.keys() <= shown.keys()
    assert {name: shown[name] for name, value in expected.items() if not same(shown[name], value)} == {}


AXES = ("k", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")


def test_the_keys_move_the_sliders_and_the_values_are_those_of_the_dataset(
    maps: Path, open_page: Callable[..., Opened]
) -> None:
    page = open_page(maps)
    with xarray.open_dataset(maps.with_suffix(".nc")) as dataset:
        at = {name: (dataset.sizes[name] - 1) // 2 for name in AXES}
        scenes_shown(page, dataset.isel(at))
        moves = [
            ("a_max_over_R", ["End"], 2),
            ("A", ["ArrowRight"], 2),
            ("c0_over_R", ["ArrowRight", "ArrowRight"], 1),
            ("lambda_over_R", ["Home", "ArrowRight"], 1),
            ("k", ["End"], 3),
        ]
        for axis, keys, place in moves:
            page.press(axis, *keys)
            at[axis] = place
            scenes_shown(page, dataset.isel(at))
            assert page.shown("status") == "nothing to report"
        assert page.page.inner_text("#axis-a_max_over_R-value") == "unbounded"
        assert page.page.get_attribute("#axis-a_max_over_R", "aria-valuetext") == "unbounded"


def test_a_pointer_reads_cells_and_a_tap_holds_one(maps: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(maps)
    with xarray.open_dataset(maps.with_suffix(".nc")) as dataset:
        middle = dataset.isel(c0_over_R=0, A=1, a_max_over_R=1)
        for number_of_map in (0, 1):
            for k, wave in [(0, 0), (3, 6), (1, 5)]:
                cell = middle.isel(k=k, lambda_over_R=wave)
                place = np.log10(float(cell["lambda_over_R"])), float(cell["k"])
                page.page.mouse.move(*page.point_of(f"explorer.parts.maps[{number_of_map}]", *place))
                page.settle()
                scenes_shown(page, cell)
        assert "follows" in page.page.inner_text("#held")
        page.page.mouse.down()
        page.page.mouse.up()
        page.page.wait_for_function("document.getElementById('held').textContent.startsWith('held')")
        held = page.shown("pull_off_force")
        page.page.mouse.move(*page.point_of("explorer.parts.maps[0]", np.log10(0.11), 0.0))
        assert page.shown("pull_off_force") == held
        # the status of a cell in words, and what has no value
        for wave, words in [(2, "contact on loading is not one disc"), (4, "a parameter is outside its range")]:
            at = np.log10(float(dataset["lambda_over_R"][wave])), 0.0
            page.page.mouse.click(*page.point_of("explorer.parts.maps[1]", *at))
            page.page.wait_for_function(f"document.getElementById('value-status').textContent.includes('{words}')")
        assert page.shown("dissipated_energy") == "no value"


def _image(page: Opened, i: int) -> np.ndarray:
    """Read the pixels of a map."""
    shape, pixels = page.page.evaluate(
        f"(() => {{ const image = explorer.parts.maps[{i}].image.data.image[0];"
        "return [image.shape, Array.from(new Uint8Array(image.buffer), one => String.fromCharCode(one)).join('')] })()"
    )
    return np.frombuffer(pixels.encode("latin-1"), dtype="<u4").reshape(shape)


def _colours(image: np.ndarray, row: float, column: float) -> list[str]:
    """List the colours of the middle part of a cell, whose centre is given in parts of the picture."""
    height, width = image.shape
    j, i = int(row * height), int(column * width)
    part = np.unique(image[j - 8 : j + 8, i - 8 : i + 8])
    return [f"#{pixel & 255:02x}{(pixel >> 8) & 255:02x}{(pixel >> 16) & 255:02x}" for pixel in part.tolist()]


def test_a_cell_has_the_colour_of_its_value_and_the_marks_of_its_flags(
    maps: Path, open_page: Callable[..., Opened]
) -> None:
    page = open_page(maps)
    page.press("A", "End")
    assert page.page.get_attribute("#flag-0", "type") == "checkbox"
    assert page.page.locator("#flags li").count() == 2, "the flag that occurs, and no value"
    with xarray.open_dataset(maps.with_suffix(".nc")) as dataset:
        values = dataset["dissipated_energy"].isel(c0_over_R=0, A=2, a_max_over_R=1).values
    # rows of the picture are cells of k, uneven as its values: 0, 0.31, 0.62, 0.9 with edges half-way between
    edges = np.array([-0.155, 0.155, 0.465, 0.76, 1.04])
    rows = (np.array([0.0, 0.31, 0.62, 0.9]) - edges[0]) / (edges[-1] - edges[0])
    for log in (True, False):
        page.page.set_checked("#log-1", log)
        page.settle()
        size = np.log10 if log else np.asarray
        part = (size(values) - size(np.nanmin(values))) / (size(np.nanmax(values)) - size(np.nanmin(values)))
        image = _image(page, 1)
        for k in range(4):
            for wave in range(7):
                found = _colours(image, rows[k], (wave + 0.5) / 7)
                if np.isnan(values[k, wave]):
                    assert set(found) == {"#d4d4d4", "#9a9a9a"}
                    continue
                expected = Viridis256[min(255, int(part[k, wave] * 256))].lower()
                assert expected in found, (log, k, wave)
                assert (len(found) == 2) == (wave == 2), (log, k, wave)
        force = _image(page, 0)
        assert all(len(_colours(force, row, 2.5 / 7)) == 1 for row in rows), "no doubt about the force"
    page.page.uncheck("#flag-0")
    page.settle()
    assert len(_colours(_image(page, 1), rows[1], 2.5 / 7)) == 1


def test_other_axes_and_variables_are_chosen(maps: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(maps)
    assert page.page.title() == "Maps </script><script>window.broken = 1</script> & more"
    assert page.page.evaluate("window.broken === undefined")
    page.page.select_option("#along-x", label="A – amplitude over wavelength of the waviness")
    page.page.select_option("#along-y", label="λ/R – wavelength of the waviness")
    page.page.select_option("#shown-1", label="number of jumps on loading, including the jump-in")
    page.settle()
    # what was across is up now, and what was up is free; two maps have one range
    figures = "explorer.parts.maps.map(map => map.figure)"
    assert (
        page.page.evaluate(f"{figures}.map(one => [one.below[0].axis_label, one.left[0].axis_label])")
        == [["A", "λ/R"]] * 2
    )
    assert page.page.evaluate(f"{figures}[0].x_range === {figures}[1].x_range")
    with xarray.open_dataset(maps.with_suffix(".nc")) as dataset:
        cell = dataset.isel(k=1, c0_over_R=0, lambda_over_R=6, A=2, a_max_over_R=1)
        place = float(cell["A"]), np.log10(float(cell["lambda_over_R"]))
        page.page.mouse.move(*page.point_of("explorer.parts.maps[1]", *place))
        page.settle()
        scenes_shown(page, cell)
        assert same(page.page.inner_text("#now-1"), float(cell["loading_jumps"]))
        # the sections are the row and the column of the cell
        row = dataset["loading_jumps"].isel(k=1, c0_over_R=0, lambda_over_R=6, a_max_over_R=1)
        column = dataset["loading_jumps"].isel(k=1, c0_over_R=0, A=2, a_max_over_R=1)
        page.page.uncheck("#log-1")
        page.settle()
        for side, values in (("x", row), ("y", column)):
            drawn = page.page.evaluate(f"Array.from(explorer.parts.sections[1].{side}.lines.data.ys[0])")
            assert drawn == values.values.tolist()


def test_a_narrow_window_has_one_column_and_a_finger_reads_a_cell(maps: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(maps, viewport={"width": 360, "height": 740}, has_touch=True)
    assert page.page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
    first, second = (page.page.locator(".plot.map").nth(i).bounding_box() for i in (0, 1))
    assert first is not None
    assert second is not None
    assert first["x"] == second["x"]
    assert second["y"] > first["y"] + first["height"]
    assert first["width"] > 300
    with xarray.open_dataset(maps.with_suffix(".nc")) as dataset:
        cell = dataset.isel(k=3, c0_over_R=0, lambda_over_R=1, A=1, a_max_over_R=1)
        place = np.log10(float(cell["lambda_over_R"])), float(cell["k"])
        page.page.touchscreen.tap(*page.point_of("explorer.parts.maps[0]", *place))
        page.page.wait_for_function("document.getElementById('held').textContent.startsWith('held')")
        scenes_shown(page, cell)


def test_a_page_can_be_read_without_a_picture(maps: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(maps)
    assert page.page.get_attribute("html", "lang") == "en"
    unlabelled = "[...document.querySelectorAll('main input, main select')].filter(one => !one.labels.length).length"
    assert page.page.evaluate(unlabelled) == 0
    assert page.page.locator(".plot:not([aria-label])").count() == 0
    assert page.page.locator("details[open]").count() == 0
    page.page.click("summary >> nth=0")
    assert "[parameters]" in page.page.inner_text("details >> nth=0")


def test_one_axis_is_drawn_as_lines_of_all_solvers(tmp_path: Path, open_page: Callable[..., Opened]) -> None:
    file = _made(tmp_path, LINES)
    page = open_page(file)
    with xarray.open_dataset(file.with_suffix(".nc")) as dataset:
        page.press("solver", "End")
        page.page.mouse.move(*page.point_of("explorer.parts.sections[1].x", np.log10(0.47), 0.0))
        page.settle()
        scene = dataset.isel(solver=1, lambda_over_R=2)
        scenes_shown(page, scene.drop_vars("solver"))  # held by the key: the pointer does not move it
        assert page.shown("solver") == "envelope"
        page.press("lambda_over_R", "End")
        scenes_shown(page, dataset.isel(solver=1, lambda_over_R=4).drop_vars("solver"))
        page.page.uncheck("#log-0")
        page.settle()
        drawn = page.page.evaluate("explorer.parts.sections[0].x.lines.data.ys.map(line => Array.from(line))")
        assert np.allclose(drawn, dataset["pull_off_force"].values, rtol=5e-6, atol=0.0)  # six digits
        assert page.page.inner_text("#lines").split() == ["exact", "envelope"]


def test_points_are_dots_over_a_parameter(tmp_path: Path, open_page: Callable[..., Opened]) -> None:
    file = _made(tmp_path, POINTS)
    page = open_page(file)
    with xarray.open_dataset(file.with_suffix(".nc")) as dataset:
        page.page.select_option("#along-x", label="λ/R – wavelength of the waviness")
        page.page.uncheck("#log-0")
        page.settle()
        dot = dataset.isel(scene=2)
        place = np.log10(float(dot["lambda_over_R"])), float(dot["pull_off_force"])
        page.page.mouse.move(*page.point_of("explorer.parts.sections[0].x", *place))
        scenes_shown(page, dot)
        page.press("scene", "Home")
        scenes_shown(page, dataset.isel(scene=0))


def test_curves_are_those_of_the_scene_on_the_sliders(tmp_path: Path, open_page: Callable[..., Opened]) -> None:
    file = _made(tmp_path, CURVES)
    page = open_page(file)
    page.press("A", "End")
    page.press("k", "End")
    with xarray.open_dataset(file.with_suffix(".nc")) as dataset:
        scene = dataset.isel(A=2, k=1)
        for name in ("A", "k"):
            assert same(page.shown(name), float(scene[name]))
        for i, (x, y) in enumerate(
            [("indentation", "load"), ("contact_radius", "indentation"), ("contact_radius", "load")]
        ):
            lines = page.page.evaluate(f"explorer.parts.planes[{i}].lines.data")
            for side, name in (("xs", x), ("ys", y)):
                drawn = np.concatenate(lines[side])
                expected = np.concatenate([scene[name].values, scene[f"path_{name}"].values])
                ends = np.nanmin(expected), np.nanmax(expected)
                assert np.allclose([drawn.min(), drawn.max()], ends, rtol=5e-6, atol=0.0)
        jumps = int(scene["path_jump"].sum())
        looks = page.page.evaluate("explorer.parts.planes[0].lines.data.width")
        thin = page.page.evaluate("explorer.study.tracks[0].jumpWidth")
        assert looks.count(thin) == jumps


def test_curves_in_units_are_those_of_the_scene(tmp_path: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(_made(tmp_path, CURVES_IN_UNITS))
    page.press("A", "End")
    with xarray.open_dataset(tmp_path / "data.nc") as dataset:
        scene = dataset.isel(A=1)
        lines = page.page.evaluate("explorer.parts.planes[0].lines.data")
        for side, name in (("xs", "indentation_si"), ("ys", "load_si")):
            drawn = np.concatenate(lines[side])
            unit = {"xs": 1e-9, "ys": 1e-6}[side]
            expected = np.concatenate([scene[name].values, scene[f"path_{name}"].values]) / unit
            ends = np.nanmin(expected), np.nanmax(expected)
            assert np.allclose([drawn.min(), drawn.max()], ends, rtol=5e-6, atol=0.0)
    axis = page.page.evaluate("explorer.parts.planes[0].figure.left[0].axis_label")
    assert axis == "load P (µN)"
    falls = page.page.evaluate("explorer.study.tracks.find((track) => track.curve === 'equilibrium').faded")
    assert falls in lines["colour"], "unstable parts are faded in units too"
    assert page.page.locator("#value-path_load_si").count() == 0


FRAMES = """explorer.figures().map((figure) => {
    const view = Bokeh.index.find_one(figure), box = view.canvas_view.el.getBoundingClientRect()
    return [box.left + view.frame.bbox.left, box.left + view.frame.bbox.right]
})"""
"""Of two maps, and of the two sections of each."""
SIZES = ((390, 844), (1280, 900), (1920, 1080))


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_the_page_is_used_and_frames_stand_in_line(
    width: int, height: int, maps: Path, open_page: Callable[..., Opened]
) -> None:
    page = open_page(maps, viewport={"width": width, "height": height})
    assert page.page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
    page.page.wait_for_function(
        f"Math.max(...({FRAMES}).slice(2).map(([left, right], i) => {{"
        f"const map = ({FRAMES})[i >> 1]; return Math.max(Math.abs(left - map[0]), Math.abs(right - map[1])) }})) < 1.5"
    )  # the layout follows the borders
    frames = page.page.evaluate(FRAMES)
    first_map, second_map, *sections = np.array(frames)
    for number_of_map, wanted in ((0, first_map), (1, second_map)):
        for frame in sections[2 * number_of_map : 2 * number_of_map + 2]:
            np.testing.assert_allclose(frame, wanted, atol=1.5)
    boxes = [page.page.locator(".plot.map").nth(i).bounding_box() for i in (0, 1)]
    right = max(box["x"] + box["width"] for box in boxes if box)
    assert right > 0.95 * width, "no part of a wide window is empty"


def test_on_a_phone_the_map_stays_in_view_of_the_sliders(maps: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(maps, viewport={"width": 390, "height": 844}, has_touch=True)
    for axis in AXES:
        page.page.evaluate(f"document.getElementById('axis-{axis}').scrollIntoView({{block: 'center'}})")
        page.settle()
        slider = page.page.locator(f"#axis-{axis}").bounding_box()
        map_box = page.page.locator(".plot.map").first.bounding_box()
        assert slider
        assert map_box
        assert -1 <= map_box["y"] < map_box["y"] + map_box["height"] <= slider["y"] + 1


def test_the_address_brings_a_colleague_to_the_same_state(maps: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(maps)
    page.press("A", "End")
    page.press("k", "Home")
    page.page.select_option("#along-y", label="A – amplitude over wavelength of the waviness")
    page.page.select_option("#shown-1", label="number of jumps on loading, including the jump-in")
    page.page.uncheck("#log-0")
    page.page.wait_for_function("location.hash.includes('loading_jumps')")
    there = open_page(maps, "#" + page.page.url.partition("#")[2])
    state = "[explorer.at, explorer.x, explorer.y, explorer.drawn, explorer.held]"
    assert there.page.evaluate(state) == page.page.evaluate(state)
    assert there.page.input_value("#along-y") == page.page.input_value("#along-y")
    wrong = open_page(maps, "#k=many&A=0.0231&x=x&show=nothing&log=,,")
    assert wrong.shown("A") == "0.023", "what can be read is taken, and nothing else"
    assert wrong.page.evaluate("explorer.x !== explorer.y")
    said = wrong.page.inner_text("#wrong")
    assert "k has no value many" in said
    assert "A has no value 0.0231, and its nearest is shown, 0.023" in said
    assert "x = x does not name two axes of this page" in said
    assert "nothing is no quantity of this page" in said
    assert there.page.is_hidden("#wrong")


def test_a_query_and_an_unknown_axis_are_said(maps: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(maps, "?k=0.62&A=0.05&lamda_over_R=0.2#A=0&a_max_over_R=inf")
    assert (page.shown("k"), page.shown("A")) == ("0.62", "0"), "what stands after # comes first"
    assert page.shown("a_max_over_R") == "unbounded"
    assert page.page.inner_text("#axis-a_max_over_R-value") == "unbounded"
    expected = "The address of this page does not fit it: lamda_over_R is no axis of this page."
    assert page.page.inner_text("#wrong") == expected
    assert open_page(maps, "#%zz=1&k=%").page.is_visible("#wrong")


def _downloaded(page: Opened, what: str) -> bytes:
    with page.page.expect_download() as waiting:
        page.page.click(f"#save-{what}")
    return Path(waiting.value.path()).read_bytes()


def test_what_is_downloaded_is_what_is_shown(maps: Path, open_page: Callable[..., Opened], tmp_path: Path) -> None:
    page = open_page(maps)
    page.press("A", "End")
    page.press("a_max_over_R", "End")
    at = {"k": 1, "c0_over_R": 0, "lambda_over_R": 3, "A": 2, "a_max_over_R": 2}
    with xarray.open_dataset(maps.with_suffix(".nc")) as dataset:
        scene = dataset.isel(at)
        rows = list(csv.DictReader(_downloaded(page, "csv").decode().splitlines()))
        assert len(rows) == dataset.sizes["k"] * dataset.sizes["lambda_over_R"]
        for row in rows:
            assert float(row["A"]) == 0.05
            near = {name: float(row[name]) for name in ("k", "lambda_over_R")}
            own = dataset.isel(c0_over_R=0, A=2, a_max_over_R=2).sel(near, method="nearest")
            for name in ("pull_off_force", "dissipated_energy", "loading_jumps"):
                wanted = float(own[name])
                assert row[name] == "" if np.isnan(wanted) else float(row[name]) == float(f"{wanted:.6g}")
        assert _downloaded(page, "png")[:4] == b"\x89PNG"
        study = tmp_path / "scene.toml"
        study.write_bytes(_downloaded(page, "toml"))
        again = gr.run(study)
        called: dict[str, Any] = {}
        exec(_downloaded(page, "py"), called)  # noqa: S102 (what the page wrote)
        for found in (again, called["scene"]):
            for name in ("pull_off_force", "dissipated_energy"):
                assert float(found[name]) == pytest.approx(float(scene[name]), rel=1e-12)


def test_a_study_of_a_scene_has_its_units_profile_and_control(tmp_path: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(_made(tmp_path, MACHINE))
    page.press("R", "End")
    with xarray.open_dataset(tmp_path / "data.nc") as dataset:
        assert page.page.evaluate("explorer.study.variables[explorer.drawn[0].variable].name") == "pull_off_force_si"
        scene = dataset.isel(R=2)
        (tmp_path / "scene.toml").write_bytes(_downloaded(page, "toml"))
        again = gr.run(tmp_path / "scene.toml")
        called: dict[str, Any] = {}
        exec(_downloaded(page, "py"), called)  # noqa: S102 (what the page wrote)
        for found in (again, called["scene"]):
            assert float(found["pull_off_force_si"]) == pytest.approx(float(scene["pull_off_force_si"]), rel=1e-11)
            assert found.attrs["profile"] == dataset.attrs["profile"]


def test_a_dark_page_has_dark_figures_and_light_words(maps: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(maps, color_scheme="dark")
    assert page.page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(22, 25, 29)"
    colours = page.page.evaluate("explorer.figures().map((figure) => figure.left[0].major_label_text_color)")
    assert {*colours} == {"#d8dade"}
    assert page.page.evaluate("theme.seen('#440154')") != "#440154"
    page.page.emulate_media(color_scheme="light")
    page.settle()
    assert page.page.evaluate("explorer.figures()[0].left[0].major_label_text_color") == "#333333"
    assert page.page.evaluate("theme.seen('#440154')") == "#440154"


def test_lines_of_curves_are_hidden_one_by_one(tmp_path: Path, open_page: Callable[..., Opened]) -> None:
    page = open_page(_made(tmp_path, CURVES))
    looks = "[...new Set(explorer.parts.planes[0].lines.data.colour)]"
    tracks = page.page.evaluate("explorer.study.tracks.map((track) => [track.label, track.colour])")
    labels = [label for label, _ in tracks]
    unloading = labels.index("unloading")
    assert tracks[unloading][1] in page.page.evaluate(looks)
    page.page.uncheck(f"#track-{unloading}")
    page.settle()
    assert tracks[unloading][1] not in page.page.evaluate(looks), "loading alone is left"
    dashes = page.page.evaluate("explorer.study.tracks.map((track) => track.dash.length)")
    assert dashes[unloading] > 0 == dashes[labels.index("loading")], "loading shows in the gaps of unloading"


def _light(colour: str) -> float:
    """Give the relative luminance of a colour, as WCAG 2 defines it."""
    parts = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255.0
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    return float(linear @ (0.2126, 0.7152, 0.0722))


def _contrast(one: str, other: str) -> float:
    """Give the contrast of two colours, 1 to 21."""
    low, high = sorted((_light(one), _light(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize(("mode", "paper"), [("dark", "#16191d"), ("light", "#ffffff")])
def test_stable_and_unstable_parts_differ(
    mode: str, paper: str, tmp_path: Path, open_page: Callable[..., Opened]
) -> None:
    page = open_page(_made(tmp_path, CURVES), color_scheme=mode)
    track = "explorer.study.tracks.find((track) => track.curve === 'equilibrium')"
    stable, unstable = page.page.evaluate(f"[theme.seen({track}.colour), theme.faded({track})]")
    drawn = page.page.evaluate("explorer.parts.planes[0].lines.data.colour")
    assert {stable, unstable} <= {*drawn}
    assert _contrast(stable, unstable) > 2.0
    assert _contrast(stable, paper) > _contrast(unstable, paper) > 1.5
    strokes = page.page.eval_on_selector_all("#lines line", "lines => lines.map((line) => line.getAttribute('stroke'))")
    assert {stable, unstable} <= {*strokes}, "the legend has the same colours"


SENSITIVE = """
title = "Sensitivities"
outputs = ["pull_off_force", "dissipated_energy", "pull_off_force_sensitivity", "dissipated_energy_sensitivity"]
[parameters]
k = [0.0, 0.3, 0.6]
nu = 0.27
modulus = 430.0
c0_over_R = 0.013
lambda_over_R = { start = 0.11, stop = 0.87, num = 7 }
A = 0.023
a_max_over_R = 1.7
"""


@pytest.fixture(scope="module")
def sensitive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return _made(tmp_path_factory.mktemp("sensitive"), SENSITIVE)


@pytest.mark.parametrize("width", [390, 1280, 1920])
def test_sensitivities_are_those_under_the_pointer_and_the_strongest_is_marked(
    width: int, sensitive: Path, open_page: Callable[..., Opened]
) -> None:
    page = open_page(sensitive, viewport={"width": width, "height": 900})
    with xarray.open_dataset(sensitive.with_suffix(".nc")) as dataset:
        for place in (0, 4):
            page.page.mouse.move(*page.point_of("explorer.parts.maps[0]", dataset["lambda_over_R"].values[place], 0.3))
            page.settle()
            scene = dataset.isel(k=1, lambda_over_R=place)
            for output in ("pull_off_force_sensitivity", "dissipated_energy_sensitivity"):
                values = {str(name): scene[output].sel(parameter=name).item() for name in scene["parameter"].values}
                sizes = {name: abs(value) for name, value in values.items() if name not in ("k", "nu")}
                cells = {name: page.page.locator(f"#value-{output}_{name}") for name in values}
                for name, cell in cells.items():
                    assert number(cell.inner_text()) == pytest.approx(values[name], rel=5.1e-4, abs=1e-12), name
                marked = [name for name, cell in cells.items() if cell.get_attribute("class") == "strongest"]
                assert marked == [max(sizes, key=sizes.__getitem__)]
    box = page.page.locator("#values").bounding_box()
    assert box
    assert box["x"] + box["width"] <= width
