"""A profile from a file: the punch of a study, its dataset, `gradhesion profile`, and what is refused."""

import hashlib
import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.errors import StudyError
from gradhesion.cli.study import load_study, study_from

Call = Callable[..., Result]

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


def table(noise: float = 0.0, head: str = "r [um],height [nm]") -> str:
    """One cosine, over one flank."""
    r = np.linspace(0.0, 1.6e-6, 600)
    h = r**2 / (2 * RADIUS) + AMPLITUDE * (1 - np.cos(2 * np.pi * r / WAVELENGTH))
    h += noise * np.random.default_rng(1).standard_normal(r.size)
    return (
        head + "\n" + "\n".join(f"{1e6 * x!r},{1e9 * y!r}" for x, y in zip(r.tolist(), h.tolist(), strict=True)) + "\n"
    )


@pytest.fixture
def study(tmp_path: Path) -> Path:
    """A study with its file."""
    (tmp_path / "tip.csv").write_text(table())
    path = tmp_path / "probe.toml"
    path.write_text(STUDY)
    return path


def mistakes(path: Path, *overrides: str) -> list[str]:
    """List what is wrong with a study."""
    with pytest.raises(StudyError) as caught:
        load_study(path, overrides)
    return list(caught.value.mistakes)


def test_one_cosine_gives_the_force_of_the_one_cosine_solver(study: Path) -> None:
    found = compute(load_study(study))
    plain = {"k": 0.0, "nu": 0.3, "R": RADIUS, "E_star": 50e6, "work_of_adhesion": 0.05, "a_max": 1.5e-6}
    expected = gr.solve(plain, "pull_off_force", wavelength=WAVELENGTH, amplitude=AMPLITUDE)
    force = expected["pull_off_force_si"].item()
    assert found["pull_off_force_si"].item() == pytest.approx(force, rel=1e-9), (
        "of heights with 12 digits beyond the noise"
    )
    assert found["R"].item() == pytest.approx(RADIUS, rel=1e-10)


def test_to_the_error_of_sampling_where_there_is_noise(study: Path, tmp_path: Path) -> None:
    (tmp_path / "tip.csv").write_text(table(noise=0.1e-9))
    found = load_study(study)
    fit = found.measured.fit
    assert fit is not None
    plain = {"k": 0.0, "nu": 0.3, "R": RADIUS, "E_star": 50e6, "work_of_adhesion": 0.05, "a_max": 1.5e-6}
    names = {"R": (RADIUS, fit.errors["radius"]), "wavelength": (WAVELENGTH, fit.errors["wavelength"])}
    names["amplitude"] = (AMPLITUDE, fit.errors["cosines"][0])

    def force(**changes: float) -> float:
        waves = {"wavelength": WAVELENGTH, "amplitude": AMPLITUDE}
        return float(gr.solve(plain | waves | changes, "pull_off_force")["pull_off_force_si"].item())

    spread = np.sqrt(sum((force(**{name: value + error}) - force()) ** 2 for name, (value, error) in names.items()))
    error = compute(found)["pull_off_force_si"].item() - force()
    sine = abs(fit.sines[0]) / AMPLITUDE  # which one cosine leaves out, and which moves the phase of the wave
    assert abs(error) < 4 * spread + force() * sine
    assert spread < 0.01 * force(), "the bound means something"
    assert 0.08e-9 < fit.residual_rms < 0.12e-9


def test_the_dataset_has_the_file_its_fingerprint_and_the_residual(
    study: Path, gradhesion: Call, tmp_path: Path
) -> None:
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
    told = gradhesion("info", output).stdout
    assert "fitted to tip.csv: residual 0.2 nm rms" in told or "fitted to tip.csv: residual 0.1" in told
    assert gradhesion("verify", output, "--sample", "1").exit_code == 0
    (tmp_path / "tip.csv").unlink()
    assert gradhesion("verify", output, "--sample", "1").exit_code == 0, "the dataset has the fit"


def test_another_file_is_refused(study: Path, tmp_path: Path) -> None:
    study.write_text(load_study(study).text)
    assert study_from(tomllib.loads(study.read_text()), folder=tmp_path).measured.sha256
    (tmp_path / "tip.csv").write_text(table(noise=1e-12))
    (sentence,) = mistakes(study)
    assert sentence.startswith(f"{study}:13: profile.file = ")


def test_without_units_the_ratios_come_from_the_fit(study: Path) -> None:
    study.write_text(
        'outputs = ["pull_off_force"]\n[parameters]\nk = 0.0\nnu = 0.3\nmodulus = 5000.0\na_max_over_R = 0.3\n'
        '[profile]\nfile = "tip.csv"\nterms = 1\nup_to = "1.5 um"\n'
    )
    found = load_study(study)
    assert found.parameters["lambda_over_R"] == pytest.approx(WAVELENGTH / RADIUS, rel=1e-10)
    assert found.parameters["A"] == pytest.approx(AMPLITUDE / WAVELENGTH, rel=1e-8)
    assert "pull_off_force_si" not in found.variables


def test_python_takes_a_file_too(study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    scene = {"k": 0.0, "nu": 0.3, "E_star": 50e6, "work_of_adhesion": 0.05, "a_max": 1.5e-6}
    found = gr.solve(scene, "pull_off_force", profile={"file": "tip.csv", "terms": 1})
    assert found["pull_off_force"].item() == compute(load_study(study))["pull_off_force"].item()


WRONG: dict[str, tuple[str, str, str]] = {  # what is replaced, by what, and the key with the beginning of its sentence
    "absent": ('file = "tip.csv"', 'file = "tap.csv"', "profile.file"),
    "no name": ('file = "tip.csv"', "file = 3", "profile.file"),
    "R": ("E_star", 'R = "1 um"\nE_star', "physical.R"),
    "A": ("k = 0.0", "k = 0.0\nA = 0.1", "parameters.A"),
    "chi": ("k = 0.0", "k = 0.0\nchi = 0.1", "parameters.chi"),
    "harmonics": ("terms = 1", "harmonics = [{ n = 1 }]", "profile.harmonics"),
    "up_to": ('a_max = "1.5 um"', "", "profile.up_to"),
    "unit of up_to": ("terms = 1", 'up_to = "2 N"', "profile.up_to"),
    "number up_to": ("terms = 1", "up_to = 2", "profile.up_to"),
    "terms": ("terms = 1", "terms = 65", "profile.terms"),
    "exponent": ("terms = 1", 'exponent = "fitt"', "profile.exponent"),
    "cone": ("terms = 1", "exponent = 1", "profile.file"),
    "without a file": ('file = "tip.csv"   # measured', "", "profile.terms"),
    "fit without a file": ('file = "tip.csv"   # measured\nterms = 1', 'exponent = "fit"', "profile.exponent"),
    "sha256": ("terms = 1", 'sha256 = "12"', "profile.sha256"),
    "misspelt": ("terms = 1", "trems = 1", "profile.trems"),
}


@pytest.mark.parametrize("name", WRONG)
def test_every_mistake_of_a_study_is_told_at_its_key(name: str, study: Path) -> None:
    old, new, key = WRONG[name]
    study.write_text(STUDY.replace(old, new, 1))
    found = mistakes(study)
    assert any(re.match(rf"{study}(:\d+)?: {re.escape(key)}( = .*)?: ", line) for line in found), found


FILES = {
    "": "has 0 bytes",
    "x [um],height [nm]\n1,2\n": 'there is no column "r"',
    "r [um],hight [nm]\n1,2\n": 'rename "hight"?',
    "r,height [nm]\n1,2\n": 'the column "r" has no unit',
    "r [um],height [V]\n1,2\n": '"height": "V" is not a unit',
    "r [um],height [nm]\n1,2\n": "too few",
    "r [um],height [nm]\n1,nan\n": "no row has two numbers",
    "r [um],height [nm]\n1,two\n": 'line 2: height = "two"',
}


@pytest.mark.parametrize("text", FILES, ids=repr)
def test_every_mistake_of_a_file_is_one_sentence_in_both_commands(
    text: str, study: Path, gradhesion: Call, tmp_path: Path
) -> None:
    (tmp_path / "tip.csv").write_text(text)
    assert any(FILES[text] in line for line in mistakes(study)), mistakes(study)
    result = gradhesion("profile", tmp_path / "tip.csv")
    assert result.exit_code == 2
    assert result.stderr.startswith(f"{tmp_path / 'tip.csv'}: ")
    assert FILES[text] in result.stderr
    assert not (tmp_path / "tip.png").exists()


@pytest.mark.parametrize("head", ["R (um),Height (nm)", "r [um];HEIGHT [nm]", "R (um)\theight (nm)"])
def test_columns_are_known_in_any_case_and_with_their_units(head: str, study: Path, tmp_path: Path) -> None:
    plain = load_study(study).parameters
    separator = head.strip("rRumheigtnHEIGT ()[]")[:1]
    (tmp_path / "tip.csv").write_text(table(head=head).replace(",", separator) if separator else table(head=head))
    assert load_study(study).parameters == plain


def test_profile_prints_a_table_that_gives_the_same_punch(study: Path, gradhesion: Call, tmp_path: Path) -> None:
    (tmp_path / "tip.csv").write_text(table(noise=0.1e-9) + "nan,3\n")
    result = gradhesion("profile", tmp_path / "tip.csv", "--terms", "2", "--exponent", "fit", "--up-to", "1.5 um")
    assert result.exit_code == 0, result.stderr
    assert "1 row was left out, for lack of two numbers" in result.stderr
    assert (tmp_path / "tip.png").read_bytes()[:4] == b"\x89PNG"
    printed = tomllib.loads(result.stdout)
    fitted = load_study(study, ["profile.terms=2", 'profile.exponent="fit"', 'profile.up_to="1.5 um"'])
    explicit = tomllib.loads(STUDY)
    explicit |= {"profile": printed["profile"], "physical": explicit["physical"] | printed["physical"]}
    other = study_from(explicit)
    assert other.profile == fitted.profile
    assert {name: other.parameters[name] for name in fitted.parameters} == dict(fitted.parameters)
    again = gradhesion("profile", tmp_path / "tip.csv")
    assert again.exit_code == 4
    assert "exists already" in again.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--up-to", "2"], "--up-to 2: a number without a unit"),
        (["--exponent", "two"], '--exponent two: a power is a finite number above 1, or "fit"'),
        (["--terms", "0"], "terms = 0: a series has 1 to 64 terms"),
        (["-o", "tip.bmp"], "tip.bmp: the name of a picture ends in .png"),
    ],
)
def test_options_that_do_not_do(arguments: list[str], words: str, study: Path, gradhesion: Call) -> None:
    result = gradhesion("profile", study.with_name("tip.csv"), *arguments)
    assert result.exit_code == 2
    assert words in result.stderr


def test_init_writes_study_and_data_and_the_fit_is_what_the_data_say(
    gradhesion: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = gradhesion("init", "profile")
    assert result.exit_code == 0
    assert "with tip.csv" in result.stderr
    fit = load_study("profile.toml").measured.fit
    assert fit is not None
    for name, true in {"radius": 5e-6, "wavelength": 0.35e-6, "centre": 0.13e-6}.items():
        assert getattr(fit, name) == pytest.approx(true, abs=4 * fit.errors[name])
    np.testing.assert_allclose(fit.cosines, [4e-9, 1e-9, 0.0], atol=4 * fit.errors["cosines"].max())
    np.testing.assert_allclose(fit.sines, [0.6e-9, 0.0, 0.0], atol=4 * fit.errors["sines"].max())
    assert 0.28e-9 < fit.residual_rms < 0.32e-9
    again = gradhesion("init", "profile", "-o", "other.toml")
    assert again.exit_code == 4, "the data stay"
    assert "tip.csv: exists already" in again.stderr
    assert not Path("other.toml").exists()
