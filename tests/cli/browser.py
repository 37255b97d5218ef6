"""Pages of `gradhesion explore` in tabs of a browser, with their datasets: what is done to them, and what they show."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from playwright.sync_api import Page

import gradhesion as gr

PUNCH: dict[str, Any] = {"k": 0.3, "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "A": 0.023, "a_max_over_R": 1.7}
WAVES = {"start": 0.11, "stop": 0.87, "num": 7, "spacing": "log"}
TIP = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "13 nm", "wavelength": "0.2 um", "a_max": "0.4 um"}  # fmt: skip
VALUES = ["pull_off_force", "dissipated_energy"]
TITLE = "Maps </script><script>window.broken = 1</script> & more"
STUDIES: dict[str, dict[str, Any]] = {
    "maps": {"title": TITLE, "outputs": [*VALUES, "loading_jumps"], "parameters": PUNCH | {
        "k": [0.0, 0.31, 0.62, 0.9], "c0_over_R": [0.013, 0.2], "lambda_over_R": WAVES, "A": [0.0, 0.023, 0.05], "a_max_over_R": [0.3, 1.7, np.inf]}},
    "lines": {"outputs": VALUES, "method": {"solver": ["exact", "envelope"]}, "parameters": PUNCH | {"lambda_over_R": WAVES | {"stop": 0.47, "num": 5}}},
    "points": {"outputs": VALUES, "layout": "points", "parameters": PUNCH | {"k": [0.1, 0.5, 0.2, 0.4], "lambda_over_R": [0.11, 0.3, 0.7, 0.2]}},
    "curves": {"kind": "curve", "outputs": ["equilibrium", "path"], "parameters": PUNCH | {"k": [0.1, 0.3], "A": [0.0, 0.023, 0.07], "lambda_over_R": 0.17, "a_max_over_R": 0.4}},
    "curves in units": {"kind": "curve", "outputs": ["equilibrium", "path"], "parameters": {"k": [0.1, 0.3], "nu": 0.27, "A": [0.0, 0.023, 0.07]}, "physical": TIP},
    "machine": {"outputs": ["pull_off_force"], "parameters": {"k": 0.3, "nu": 0.27, "A": 0.03}, "loading": {"control": "machine"},
                "physical": TIP | {"R": ["1 um", "2 um", "3 um"], "spring_constant": "2 N/m"}, "profile": {"exponent": 2.0, "harmonics": [{"n": 1}, {"n": 2, "cos": 0.2}]}},
    "rough": {"outputs": ["pull_off_force"], "parameters": PUNCH | {"lambda_over_R": [0.11, 0.3]}, "profile": {"spectrum": {"hurst": 0.8, "first": 1, "last": 4, "realisations": 5, "seed": 1}}},
    "sensitivities": {"outputs": [*VALUES, *(f"{name}_sensitivity" for name in VALUES)], "parameters": PUNCH | {"k": [0.0, 0.3, 0.6], "lambda_over_R": WAVES | {"spacing": "linear"}}},
}  # fmt: skip
APART = ("status", "steep_contact", "solver")
"""What the page says in words."""
DRAWN = "await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
"""The page has drawn what it was asked for."""


def written(name: str, folder: Path) -> Path:
    """Write the page of a study beside its dataset, once."""
    page = folder / f"{name}.html"
    if not page.exists():
        dataset = gr.run(STUDIES[name])
        if name == "maps":  # one column of the first map has a flag, and one cell no value
            dataset["status"][...] = 0
            dataset["status"][:, :, 2] = gr.FLAGS["loading_contact_not_one_disc"]  # which doubts the energy alone
            dataset["status"][0, :, 4] = gr.FLAGS["no_value"]
            for value in VALUES:
                dataset[value][0, :, 4] = np.nan
        dataset.to_netcdf(page.with_suffix(".nc"))
        gr.explore(page.with_suffix(".nc"))
    return page


class Opened:
    """A page in a tab, what it asked for and what it complained of."""

    def __init__(self, tab: Page, file: Path, address: str = "") -> None:
        self.page = tab
        self.page.set_default_timeout(120_000)  # a busy machine
        self.requests: list[str] = []
        self.complaints: list[str] = []
        self.listeners: dict[Any, Any] = {
            "request": lambda request: self.requests.append(request.url),
            "pageerror": lambda error: self.complaints.append(str(error)),
            "console": lambda told: self.complaints.append(f"{told.type}: {told.text}"),
        }
        with xarray.open_dataset(file.with_suffix(".nc")) as dataset:
            self.dataset = dataset.load()
        tab.goto("about:blank")  # another address of one page would not load it anew
        for event, listener in self.listeners.items():
            tab.on(event, listener)
        tab.goto(file.as_uri() + address)
        tab.wait_for_selector("html[data-ready=true]", state="attached")

    def js(self, expression: str) -> Any:
        return self.page.evaluate(f"async () => {{ {DRAWN}; return {expression} }}")

    def text(self, element: str) -> str:
        return str(self.js(f"document.getElementById('{element}').innerText"))

    def press(self, axis: str, *keys: str) -> None:
        self.page.focus(f"#axis-{axis}")
        for key in keys:
            self.page.keyboard.press(key)
        self.js("null")

    def point_of(self, part: str, x: Any, y: Any) -> tuple[float, float]:
        self.js(f"(window.view = Bokeh.index.find_one({part}.figure)).el.scrollIntoView({{block: 'center'}})")
        frame, box = "view.frame", "view.canvas_view.el.getBoundingClientRect()"
        ends = f"{box}.left + {frame}.x_scale.compute({float(x)}), {box}.top + {frame}.y_scale.compute({float(y)})"
        left, top = self.js(f"[{ends}]")
        return float(left), float(top)

    def point(self, part: str, x: Any, y: Any) -> None:
        self.page.mouse.move(*self.point_of(part, x, y))
        self.js("null")

    def boxes(self, which: str) -> list[dict[str, float]]:
        return list(
            self.js(f"[...document.querySelectorAll('{which}')].map(one => one.getBoundingClientRect().toJSON())")
        )

    def wait_for_text(self, element: str, text: str) -> None:
        self.page.wait_for_function(f"document.getElementById('{element}').textContent.includes('{text}')")

    def download(self, what: str) -> bytes:
        with self.page.expect_download() as waiting:
            self.page.click(f"#save-{what}")
        return Path(waiting.value.path()).read_bytes()

    def shows(self, **at: int) -> xarray.Dataset:
        """Compare all that the table has with a scene of the dataset, and return that."""
        scene = self.dataset.isel(at)
        rows = self.js("[...document.querySelectorAll('td[id]')].map(cell => [cell.id, cell.textContent])")
        shown = {name.removeprefix("value-"): text for name, text in rows}
        expected = {str(name): float(scene[name]) for name in (*scene.data_vars, *scene.coords) if name not in APART}
        assert expected.keys() <= shown.keys()
        assert {name: shown[name] for name, value in expected.items() if not same(shown[name], value)} == {}
        return scene

    def closed(self) -> None:
        """Leave the tab to the next, and check that this one needed nothing else and complained of nothing."""
        for event, listener in self.listeners.items():
            self.page.remove_listener(event, listener)
        assert [url[:60] for url in self.requests if not url.startswith(("file:", "data:", "blob:"))] == []
        assert len([url for url in self.requests if url.startswith("file:")]) == 1
        assert [told for told in self.complaints if not told.startswith(("log:", "info:", "debug:"))] == []


def number(text: str) -> float:
    if text in {"∞", "unbounded", "no value"}:
        return np.nan if text == "no value" else np.inf
    plain = text.translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--"))  # noqa: RUF001
    power = "10" in plain and text != plain
    return float(re.sub(r"^(10)(?=-?\d)", "1×10", plain).replace("×10", "e") if power else plain)  # noqa: RUF001


def same(text: str, value: float) -> bool:
    """Tell whether a text is a value to six digits."""
    return np.array_equal(number(text), float(f"{value:.6g}"), equal_nan=True)
