"""A profile from a file: the punch of a study, its dataset, `gradhesion profile`, and what is refused."""

import hashlib
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.study import load_study, study_from
from tests.cli.conftest import Call, Patch, Told, mistakes_of

STUDY = """\
outputs = ["pull_off_force"]

[parameters]
k = 0.0
nu = 0.3

[physical]
E_star = "50 MPa"
work_of_adhesion = "50 mJ/m^2"
a_max = "1.5 um"

[profile]
file = "tip.csv"   # measured
terms = 1
"""
RADIUS, WAVELENGTH, AMPLITUDE = 5e-6, 0.35e-6, 4e-9
PLAIN = {"k": 0.0, "nu": 0.3, "E_star": 50e6, "work_of_adhesion": 0.05, "a_max": 1.5e-6}


def table(noise: float = 0.0) -> str:
    r = np.linspace(0.0, 1.6e-6, 600)
    h = r**2 / (2 * RADIUS) + AMPLITUDE * (1 - np.cos(2 * np.pi * r / WAVELENGTH))
    h += noise * np.random.default_rng(1).standard_normal(r.size)
    rows = (f"{1e6 * x!r},{1e9 * y!r}" for x, y in zip(r.tolist(), h.tolist(), strict=True))
    return "\n".join(["r [um],height [nm]", *rows, ""])


def force(**changes: float) -> float:
    waves = {"R": RADIUS, "wavelength": WAVELENGTH, "amplitude": AMPLITUDE}
    return float(gr.solve(PLAIN | waves | changes, "pull_off_force")["pull_off_force_si"].item())


@pytest.fixture
def study(tmp_path: Path) -> Path:
    (tmp_path / "tip.csv").write_text(table())
    path = tmp_path / "probe.toml"
    path.write_text(STUDY)
    return path


def test_one_cosine_gives_the_force_of_the_one_cosine_solver(study: Path, monkeypatch: Patch) -> None:
    """To the 12 digits of the heights, and in Python as in a study."""
    found = compute(load_study(study))
    assert found["pull_off_force_si"].item() == pytest.approx(force(), rel=1e-9)
    assert found["R"].item() == pytest.approx(RADIUS, rel=1e-10)
    monkeypatch.chdir(study.parent)
    alike = gr.solve(PLAIN, "pull_off_force", profile={"file": "tip.csv", "terms": 1})
    assert alike["pull_off_force"].item() == found["pull_off_force"].item()


def test_the_dataset_has_file_fingerprint_and_residual(study: Path, gradhesion: Call, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    (tmp_path / "tip.csv").write_text(table(noise=0.2e-9))
    assert gradhesion("run", study, "-o", output, "--quiet").exit_code == 0
    sha256 = hashlib.sha256((tmp_path / "tip.csv").read_bytes()).hexdigest()
    with xarray.open_dataset(output) as dataset:
        assert (dataset.profile_file, dataset.profile_sha256) == ("tip.csv", sha256)
        assert 0.15e-9 < dataset.profile_residual_rms < 0.25e-9 < dataset.profile_residual_max < 1.2e-9
        stored = dataset.attrs["study"]
    assert tomllib.loads(stored)["profile"]["sha256"] == sha256
    assert "# measured" in stored
    assert "tip.csv" in gradhesion("info", output).stdout
    assert gradhesion("verify", output, "--sample", "1").exit_code == 0
    study.write_text(stored)
    assert study_from(tomllib.loads(stored), folder=tmp_path).measured.sha256 == sha256
    (tmp_path / "tip.csv").write_text(table(noise=1e-12))
    (sentence,) = mistakes_of(study)
    assert sentence.startswith(f"{study}:13: profile.file = "), "it is another file"
    (tmp_path / "tip.csv").unlink()
    assert gradhesion("verify", output, "--sample", "1").exit_code == 0, "the dataset has the fit"


def test_without_units_the_ratios_come_from_the_fit(study: Path) -> None:
    parameters = {"k": 0.0, "nu": 0.3, "modulus": 5000.0, "a_max_over_R": 0.3}
    profile = {"file": "tip.csv", "terms": 1, "up_to": "1.5 um"}
    keys = {"outputs": ["pull_off_force"], "parameters": parameters, "profile": profile}
    found = study_from(keys, folder=study.parent)
    assert found.parameters["lambda_over_R"] == pytest.approx(WAVELENGTH / RADIUS, rel=1e-10)
    assert found.parameters["A"] == pytest.approx(AMPLITUDE / WAVELENGTH, rel=1e-8)
    assert "pull_off_force_si" not in found.variables


WRONG: dict[tuple[str, str], str] = {  # what is replaced, by what: the key that is named
    ('file = "tip.csv"', 'file = "tap.csv"'): "profile.file",
    ('file = "tip.csv"', "file = 3"): "profile.file",
    ("E_star", 'R = "1 um"\nE_star'): "physical.R",
    ("k = 0.0", "k = 0.0\nA = 0.1"): "parameters.A",
    ("k = 0.0", "k = 0.0\nchi = 0.1"): "parameters.chi",
    ("terms = 1", "harmonics = [{ n = 1 }]"): "profile.harmonics",
    ('a_max = "1.5 um"', ""): "profile.up_to",
    ("terms = 1", 'up_to = "2 N"'): "profile.up_to",
    ("terms = 1", "up_to = 2"): "profile.up_to",
    ("terms = 1", "terms = 65"): "profile.terms",
    ("terms = 1", 'exponent = "fitt"'): "profile.exponent",
    ("terms = 1", "exponent = 1"): "profile.file",
    ('file = "tip.csv"   # measured', ""): "profile.terms",
    ('file = "tip.csv"   # measured\nterms = 1', 'exponent = "fit"'): "profile.exponent",
    ("terms = 1", 'sha256 = "12"'): "profile.sha256",
    ("terms = 1", "trems = 1"): "profile.trems",
}


@pytest.mark.parametrize("change", WRONG, ids=str)
def test_every_mistake_of_a_study_is_told_at_its_key(change: tuple[str, str], study: Path) -> None:
    study.write_text(STUDY.replace(*change, 1))
    found = mistakes_of(study)
    assert any(re.match(rf"{study}(:\d+)?: {re.escape(WRONG[change])}( = .*)?: ", line) for line in found), found


def test_what_else_is_missing_is_told_beside_a_file_that_cannot_be_read(study: Path) -> None:
    study.write_text(STUDY.replace("tip.csv", "tap.csv").replace("nu = 0.3\n", "").replace('E_star = "50 MPa"\n', ""))
    told = [line.split(": ")[1].split(" = ")[0] for line in mistakes_of(study)]
    assert told == ["parameters.nu", "physical.E_star", "profile.file"]


@pytest.mark.parametrize("text", ["x [um],height [nm]\n1,2\n", "r [um],hight [nm]\n1,2\n", "r [um],height [nm]\n1,2\n"])
def test_a_table_of_other_columns_or_too_few_rows_is_refused(text: str, study: Path, refusal: Told) -> None:
    table = study.with_name("tip.csv")
    table.write_text(text)
    assert len(mistakes_of(study)) == 1
    assert refusal("profile", table).startswith(f"{table}: ")
    assert not table.with_suffix(".png").exists()


def test_profile_prints_a_table_that_gives_the_same_punch(study: Path, gradhesion: Call, tmp_path: Path) -> None:
    (tmp_path / "tip.csv").write_text(table(noise=0.1e-9) + "nan,3\n")
    result = gradhesion("profile", tmp_path / "tip.csv", "--terms", "2", "--exponent", "fit", "--up-to", "1.5 um")
    assert result.exit_code == 0, result.stderr
    assert "1 row" in result.stderr
    assert (tmp_path / "tip.png").read_bytes()[:4] == b"\x89PNG"
    printed = tomllib.loads(result.stdout)
    fitted = load_study(study, ["profile.terms=2", 'profile.exponent="fit"', 'profile.up_to="1.5 um"'])
    explicit = tomllib.loads(STUDY)
    explicit |= {"profile": printed["profile"], "physical": explicit["physical"] | printed["physical"]}
    other = study_from(explicit)
    assert other.profile == fitted.profile
    assert {name: other.parameters[name] for name in fitted.parameters} == dict(fitted.parameters)
    assert gradhesion("profile", tmp_path / "tip.csv").exit_code == 4, "the picture exists already"


@pytest.mark.parametrize("words", ["--up-to 2", "--exponent two", "--exponent 1", "--terms 0", "-o tip.bmp"])
def test_options_that_do_not_do(words: str, study: Path, gradhesion: Call) -> None:
    assert words.split()[1] in gradhesion("profile", study.with_name("tip.csv"), *words.split(), code=2).stderr


def test_init_writes_study_and_data_that_are_fitted(gradhesion: Call, tmp_path: Path, monkeypatch: Patch) -> None:
    monkeypatch.chdir(tmp_path)
    assert gradhesion("init", "profile").exit_code == 0
    fit = load_study("profile.toml").measured.fit
    assert fit is not None
    for name, true in {"radius": 5e-6, "wavelength": 0.35e-6, "centre": 0.13e-6}.items():
        assert getattr(fit, name) == pytest.approx(true, abs=4 * fit.errors[name])
    np.testing.assert_allclose(fit.cosines, [4e-9, 1e-9, 0.0], atol=4 * fit.errors["cosines"].max())
    np.testing.assert_allclose(fit.sines, [0.6e-9, 0.0, 0.0], atol=4 * fit.errors["sines"].max())
    assert 0.28e-9 < fit.residual_rms < 0.32e-9
    assert gradhesion("init", "profile", "-o", "other.toml").exit_code == 4, "the data stay"
    assert not Path("other.toml").exists()
