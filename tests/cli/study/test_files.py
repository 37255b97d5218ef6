"""Points and a profile from files: what a study takes of them, what its dataset says of them, and what is refused."""

import hashlib
import tomllib
from pathlib import Path

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.study import load_study, study_from
from tests.cli.conftest import PROFILE, Call, Made, Patch, Told, mistakes_of

LISTS: dict[str, list[float]] = {
    "modulus": [430.0, 517.3, 611.9],
    "lambda_over_R": [0.11, 0.23, 0.17],
    "A": [0.0, 0.023, 0.041],
    "a_max_over_R": [1.7, np.inf, 0.9],
}
REST = {"k": 0.31, "nu": 0.27, "c0_over_R": 0.013}
POINTS = """title = "Drawn"   # a comment stays
outputs = ["pull_off_force"]

[parameters]
points = "samples.csv"   # beside the study
k = 0.31
nu = 0.27
c0_over_R = 0.013
"""
TABLE = "\n".join([",".join(LISTS), *(",".join(map(repr, row)) for row in zip(*LISTS.values(), strict=True))]) + "\n"


@pytest.fixture
def points(tmp_path: Path, write_study: Made) -> Path:
    (tmp_path / "samples.csv").write_text(TABLE)
    return write_study(POINTS)


def test_a_file_gives_what_lists_give(points: Path, tmp_path: Path) -> None:
    lists = study_from({"layout": "points", "outputs": ["pull_off_force"], "parameters": REST | LISTS})
    xarray.Dataset({name: ("draw", values) for name, values in LISTS.items()}).to_netcdf(tmp_path / "samples.nc")
    for found in (load_study(points), load_study(points, ['parameters.points="samples.nc"'])):
        assert found.sizes == lists.sizes == {"scene": 3}
        assert list(found.parameters) == list(lists.parameters)
        for name, values in lists.parameters.items():
            np.testing.assert_array_equal(found.parameters[name], values)
    assert load_study(points, ["parameters.k=[0.1, 0.2, 0.3]", 'layout="points"']).scenes == 3, "beside a list as long"


def test_the_stored_study_has_the_fingerprint_and_is_read_again(points: Path, tmp_path: Path) -> None:
    found = load_study(points)
    table = {"file": "samples.csv", "sha256": hashlib.sha256(TABLE.encode()).hexdigest()}
    assert tomllib.loads(found.text)["parameters"]["points"] == table
    assert found.text.count("#") == 2, "comments stay"
    points.write_text(found.text)
    assert load_study(points).text == found.text
    assert load_study(points, ['title="Other"']).points.sha256 == table["sha256"]
    assert tomllib.loads(load_study(points, ['parameters.points="samples.csv"']).text) == tomllib.loads(found.text)
    columns = {name: np.array(values) for name, values in LISTS.items()}
    assert study_from(tomllib.loads(found.text), folder="/nowhere", columns=columns).scenes == 3, "the file is known"
    (tmp_path / "samples.csv").write_text(TABLE.replace("0.041", "0.042"))
    (sentence,) = mistakes_of(points)
    assert sentence.startswith(f"{points}:5: parameters.points = ")


def test_however_it_is_written(points: Path) -> None:
    pairs = [f"{name} = {value}" for name, value in REST.items()]
    for text in (
        "[parameters]\npoints = 'samples.csv'\n" + "\n".join(pairs),
        f'parameters = {{ points = "samples.csv", {", ".join(pairs)} }}\n',
        'parameters.points = "samples.csv" # x\n' + "".join(f"parameters.{pair}\n" for pair in pairs),
    ):
        points.write_text(f'outputs = ["pull_off_force"]\n{text}')
        found = load_study(points)
        assert tomllib.loads(found.text)["parameters"]["points"]["sha256"] == found.points.sha256
        assert found.scenes == 3


def test_units_are_those_of_the_header(points: Path, tmp_path: Path) -> None:
    physical = 'physical={E_star="1 GPa", work_of_adhesion="50 mJ/m^2", c0="1 um", wavelength="0.1 um"}'
    for header in ("R [um],A [%]", "R (um),A (%)"):
        (tmp_path / "samples.csv").write_text(f"{header}\n25,0.0\n2.5,1\n")
        points.write_text(POINTS.replace("c0_over_R = 0.013\n", ""))
        found = load_study(points, [physical]).parameters
        np.testing.assert_array_equal(found["R"], [25e-6, 2.5e-6])
        np.testing.assert_array_equal(found["A"], [0.0, 0.01])


def test_every_mistake_of_a_file_names_study_line_value_and_remedy(points: Path, tmp_path: Path) -> None:
    table = TABLE.replace("a_max_over_R", "a_mx_over_R").replace("0.041", "-0.041")
    (tmp_path / "samples.csv").write_text(table.replace("0.11,0.0,1.7\n517.3,0.23", "nan,0.0,1.7\n517.3,nan"))
    found = mistakes_of(points)
    assert len(found) == 3
    assert all(line.startswith(f'{points}:5: parameters.points = "samples.csv": ') for line in found)
    missing = "line 2: lambda_over_R is missing (NaN), and 1 more row"
    for words in ('did you mean "a_max_over_R"?', "line 4: A = -0.041", missing):
        assert any(words in line for line in found), found


def test_python_and_verify_find_the_file(points: Path, gradhesion: Call, tmp_path: Path, monkeypatch: Patch) -> None:
    """Or what the dataset has of it."""
    assert gr.run(gr.load(points), set={"parameters.k": 0.0})["k"].values.tolist() == [0.0, 0.0, 0.0]
    output = tmp_path / "out.nc"
    assert gradhesion("run", points, "-o", output, "--quiet").exit_code == 0
    with xarray.open_dataset(output) as dataset:
        commented = [name for name in dataset.coords if "samples.csv" in dataset[name].attrs.get("comment", "")]
    assert sorted(map(str, commented)) == sorted(LISTS)
    monkeypatch.chdir(tmp_path)
    assert gr.load(tomllib.loads(points.read_text())).scenes == 3
    (tmp_path / "samples.csv").unlink()
    assert gradhesion("verify", output, "--sample", "2").exit_code == 0


def test_shards_and_merge_find_the_file(points: Path, gradhesion: Call, tmp_path: Path, monkeypatch: Patch) -> None:
    output = tmp_path / "elsewhere" / "out.nc"
    output.parent.mkdir()
    monkeypatch.chdir(output.parent)
    monkeypatch.setenv("GRADHESION_CHUNK", "1")
    for shard in ("1/2", "2/2"):
        assert gradhesion("run", points, "-o", output, "--quiet", "--shard", shard).exit_code == 0
    (tmp_path / "samples.csv").write_text(TABLE + "1,1,1,1\n")
    assert "samples.csv" in gradhesion("merge", output, code=2).stderr
    (tmp_path / "samples.csv").write_text(TABLE)
    assert gradhesion("merge", output, "--quiet").exit_code == 0
    with xarray.open_dataset(output) as found:
        np.testing.assert_array_equal(found["pull_off_force"], gr.run(points)["pull_off_force"])


PROBE = PROFILE.replace("table.csv", "tip.csv")
RADIUS, WAVELENGTH, AMPLITUDE = 5e-6, 0.35e-6, 4e-9
PLAIN = {"k": 0.0, "nu": 0.3, "E_star": 50e6, "work_of_adhesion": 0.05, "a_max": 1.5e-6}


def table(noise: float = 0.0) -> str:
    r = np.linspace(0.0, 1.6e-6, 600)
    h = r**2 / (2 * RADIUS) + AMPLITUDE * (1 - np.cos(2 * np.pi * r / WAVELENGTH))
    h += noise * np.random.default_rng(1).standard_normal(r.size)
    rows = (f"{1e6 * x!r},{1e9 * y!r}" for x, y in zip(r.tolist(), h.tolist(), strict=True))
    return "\n".join(["r [um],height [nm]", *rows, ""])


@pytest.fixture
def probe(tmp_path: Path, write_study: Made) -> Path:
    (tmp_path / "tip.csv").write_text(table())
    return write_study(PROBE)


def test_one_cosine_gives_the_force_of_the_one_cosine_solver(probe: Path, monkeypatch: Patch) -> None:
    """To the 12 digits of the heights, and in Python as in a study."""
    found = compute(load_study(probe))
    waves = {"R": RADIUS, "wavelength": WAVELENGTH, "amplitude": AMPLITUDE}
    force = gr.solve(PLAIN | waves, "pull_off_force")["pull_off_force_si"].item()
    assert found["pull_off_force_si"].item() == pytest.approx(force, rel=1e-9)
    assert found["R"].item() == pytest.approx(RADIUS, rel=1e-10)
    monkeypatch.chdir(probe.parent)
    alike = gr.solve(PLAIN, "pull_off_force", profile={"file": "tip.csv", "terms": 1})
    assert alike["pull_off_force"].item() == found["pull_off_force"].item()


def test_the_dataset_has_file_fingerprint_and_residual(probe: Path, gradhesion: Call, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    (tmp_path / "tip.csv").write_text(table(noise=0.2e-9))
    assert gradhesion("run", probe, "-o", output, "--quiet").exit_code == 0
    sha256 = hashlib.sha256((tmp_path / "tip.csv").read_bytes()).hexdigest()
    with xarray.open_dataset(output) as dataset:
        assert (dataset.profile_file, dataset.profile_sha256) == ("tip.csv", sha256)
        assert 0.15e-9 < dataset.profile_residual_rms < 0.25e-9 < dataset.profile_residual_max < 1.2e-9
        stored = dataset.attrs["study"]
    assert tomllib.loads(stored)["profile"]["sha256"] == sha256
    assert "# measured" in stored
    assert "tip.csv" in gradhesion("info", output).stdout
    assert gradhesion("verify", output, "--sample", "1").exit_code == 0
    probe.write_text(stored)
    assert study_from(tomllib.loads(stored), folder=tmp_path).measured.sha256 == sha256
    (tmp_path / "tip.csv").write_text(table(noise=1e-12))
    (sentence,) = mistakes_of(probe)
    assert sentence.startswith(f"{probe}:10: profile.file = "), "it is another file"
    (tmp_path / "tip.csv").unlink()
    assert gradhesion("verify", output, "--sample", "1").exit_code == 0, "the dataset has the fit"


def test_without_units_the_ratios_come_from_the_fit(probe: Path) -> None:
    parameters = {"k": 0.0, "nu": 0.3, "modulus": 5000.0, "a_max_over_R": 0.3}
    profile = {"file": "tip.csv", "terms": 1, "up_to": "1.5 um"}
    keys = {"outputs": ["pull_off_force"], "parameters": parameters, "profile": profile}
    found = study_from(keys, folder=probe.parent)
    assert found.parameters["lambda_over_R"] == pytest.approx(WAVELENGTH / RADIUS, rel=1e-10)
    assert found.parameters["A"] == pytest.approx(AMPLITUDE / WAVELENGTH, rel=1e-8)
    assert "pull_off_force_si" not in found.variables


@pytest.mark.parametrize("text", ["x [um],height [nm]\n1,2\n", "r [um],hight [nm]\n1,2\n", "r [um],height [nm]\n1,2\n"])
def test_a_table_of_other_columns_or_too_few_rows_is_refused(text: str, probe: Path, refusal: Told) -> None:
    table = probe.with_name("tip.csv")
    table.write_text(text)
    assert len(mistakes_of(probe)) == 1
    assert refusal("profile", table).startswith(f"{table}: ")
    assert not table.with_suffix(".png").exists()


def test_profile_prints_a_table_that_gives_the_same_punch(probe: Path, gradhesion: Call, tmp_path: Path) -> None:
    (tmp_path / "tip.csv").write_text(table(noise=0.1e-9) + "nan,3\n")
    result = gradhesion("profile", tmp_path / "tip.csv", "--terms", "2", "--exponent", "fit", "--up-to", "1.5 um")
    assert result.exit_code == 0, result.stderr
    assert "1 row" in result.stderr
    assert (tmp_path / "tip.png").read_bytes()[:4] == b"\x89PNG"
    printed = tomllib.loads(result.stdout)
    fitted = load_study(probe, ["profile.terms=2", 'profile.exponent="fit"', 'profile.up_to="1.5 um"'])
    explicit = tomllib.loads(PROBE)
    explicit |= {"profile": printed["profile"], "physical": explicit["physical"] | printed["physical"]}
    other = study_from(explicit)
    assert other.profile == fitted.profile
    assert {name: other.parameters[name] for name in fitted.parameters} == dict(fitted.parameters)
    assert gradhesion("profile", tmp_path / "tip.csv").exit_code == 4, "the picture exists already"


@pytest.mark.parametrize("words", ["--up-to 2", "--exponent two", "--exponent 1", "--terms 0", "-o tip.bmp"])
def test_options_that_do_not_do(words: str, probe: Path, gradhesion: Call) -> None:
    assert words.split()[1] in gradhesion("profile", probe.with_name("tip.csv"), *words.split(), code=2).stderr


def test_init_writes_study_and_data_that_are_fitted(gradhesion: Call, tmp_path: Path, monkeypatch: Patch) -> None:
    monkeypatch.chdir(tmp_path)
    assert gradhesion("init", "profile").exit_code == 0
    fit = load_study("profile.toml").measured.fit
    for name, true in {"radius": 5e-6, "wavelength": 0.35e-6, "centre": 0.13e-6}.items():
        assert getattr(fit, name) == pytest.approx(true, abs=4 * fit.errors[name])
    np.testing.assert_allclose(fit.cosines, [4e-9, 1e-9, 0.0], atol=4 * fit.errors["cosines"].max())
    np.testing.assert_allclose(fit.sines, [0.6e-9, 0.0, 0.0], atol=4 * fit.errors["sines"].max())
    assert 0.28e-9 < fit.residual_rms < 0.32e-9
    assert gradhesion("init", "profile", "-o", "other.toml").exit_code == 4, "the data stay"
    assert not Path("other.toml").exists()
