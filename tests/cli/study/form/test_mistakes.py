"""Every mistake of a study gives its sentence, with exit 2, and nothing is written."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from gradhesion.cli.terminal.printable import printable_line

GOOD = """\
title = "Good"
kind = "map"
layout = "grid"
outputs = ["pull_off_force"]

[parameters]
k = [0.0, 0.5]
nu = 0.3
modulus = 500.0
c0_over_R = 0.01
lambda_over_R = { start = 0.1, stop = 0.5, num = 3, spacing = "log" }
A = 0.1
a_max_over_R = inf

[method]
solver = "exact"
"""

CURVE = (
    'kind = "map"\nlayout = "grid"\noutputs = ["pull_off_force"]',
    'kind = "curve"\nlayout = "grid"\noutputs = ["pull_off_force"]',
)

# What is replaced, by what, and what the message must say: line, key, value, remedy.
MISTAKES = {
    "unknown key": ('title = "Good"', 'titel = "x"', r':1: titel = "x": .*did you mean "title"'),
    "unknown parameter": ("A = 0.1", "A = 0.1\ncolour = 1", r":13: parameters.colour = 1: unknown key; choose from"),
    "unknown table": ("[method]", "[methods]", r':15: methods = .*did you mean "method"'),
    "quantity in the wrong table": (
        "A = 0.1",
        'A = 0.1\nR = "1 mm"',
        r':13: parameters.R = "1 mm": .*under \[physical\]',
    ),
    "stiffness in the wrong table": ("A = 0.1", "A = 0.1\nmachine_stiffness = 3", r":13: .* belongs under \[loading\]"),
    "parameter in a table of its own": (
        "[method]",
        "[loading]\nk = 0.3\n[method]",
        r":16: loading.k = 0.3: this key belongs under \[parameters\]",
    ),
    "key in the wrong table": ("[method]", "", r':16: parameters.solver = "exact": .*belongs under \[method\]'),
    "misspelt key of a table at the top": (
        'title = "Good"',
        'title = "Good"\nlambda_over_r = 1',
        r':2: lambda_over_r = 1: unknown key; did you mean "lambda_over_R", under \[parameters\]\?',
    ),
    "unknown method key": ("solver =", "sovler =", r':16: method.sovler = "exact": .*did you mean "solver"'),
    "missing outputs": ('outputs = ["pull_off_force"]', "", r": outputs: this key is required"),
    "missing parameter": ("nu = 0.3\n", "", r":6: parameters.nu: this parameter is required; write for example nu"),
    "parameters no table": ("[parameters]", "[parameter]", r':6: parameter = .*did you mean "parameters"'),
    "title no string": ('title = "Good"', "title = 3", r":1: title = 3: this must be a string"),
    "title of two lines": ('title = "Good"', r'title = "a\nb"', r":1: title = .*one line"),
    "kind unknown": ('kind = "map"', 'kind = "mop"', r':2: kind = "mop": .*did you mean "map"'),
    "curve in a map study": (
        '["pull_off_force"]',
        '["path"]',
        r':4: outputs\[0\] = "path": an output of studies of kind "curve", .*or write kind = "curve"',
    ),
    "map output in a curve study": (
        *CURVE,
        r':4: outputs\[0\] = "pull_off_force": an output of studies of kind "map", .*or write kind = "map"',
    ),
    "curve misspelt": (
        CURVE[0],
        CURVE[1].replace("pull_off_force", "pth"),
        r':4: outputs\[0\] = .*did you mean "path"',
    ),
    "variable of a curve misspelt": (
        CURVE[0],
        CURVE[1].replace("pull_off_force", "path_lod"),
        r':4: outputs\[0\] = .*did you mean "path_load"',
    ),
    "curve and its variable": (
        CURVE[0],
        CURVE[1].replace('"pull_off_force"', '"path", "path_load"'),
        r':4: outputs\[1\] = "path_load": a variable of "path", .*remove one',
    ),
    "curve twice": (
        CURVE[0],
        CURVE[1].replace('"pull_off_force"', '"path", "path"'),
        r':4: outputs\[1\] = "path": this output is listed twice',
    ),
    "too many curves": (
        GOOD[GOOD.index("kind") :],
        GOOD[GOOD.index("kind") :].replace(*CURVE).replace("pull_off_force", "path").replace("num = 3", "num = 501"),
        r':2: kind = "curve": a curve study has at most 1,000 scenes, and this one has 1,002; use fewer',
    ),
    "solver of a curve study": (
        GOOD[GOOD.index("kind") :],
        GOOD[GOOD.index("kind") :].replace(*CURVE).replace("pull_off_force", "path").replace('"exact"', '"envelope"'),
        r':16: method.solver = "envelope": a curve study has no solver.*remove this key',
    ),
    "contact of a curve study": (
        GOOD[GOOD.index("kind") :],
        GOOD[GOOD.index("kind") :]
        .replace(*CURVE)
        .replace("pull_off_force", "path")
        .replace('solver = "exact"', "check_contact = false"),
        r":16: method.check_contact = false: the path of a curve study is always checked; remove this key",
    ),
    "solver unknown in a curve study": (
        GOOD[GOOD.index("kind") :],
        GOOD[GOOD.index("kind") :].replace(*CURVE).replace("pull_off_force", "path").replace('"exact"', '["exakt"]'),
        r':16: method.solver = \["exakt"\]: a curve study has no solver.*remove this key',
    ),
    "radius twice": (
        "a_max_over_R = inf",
        "a_max_over_R = inf\na_max_over_a2 = 2.0",
        r":14: parameters.a_max_over_a2 = 2.0: a_max_over_R gives the radius of the punch already; .*remove the other",
    ),
    "radius misspelt": (
        "a_max_over_R",
        "a_max_over_a_2",
        r':13: .*a_max_over_a_2 = inf: .*did you mean "a_max_over_a2"',
    ),
    "radius out of range": ("a_max_over_R = inf", "a_max_over_a2 = [1.0, 0.0]", r":13: .*a2\[1\] = 0.0: out of range"),
    "radius to inf": (
        "a_max_over_R = inf",
        "a_max_over_a2 = { start = 1.0, stop = inf, num = 2 }",
        r":13: .*a2.stop = inf: a range must end at finite values",
    ),
    "wavelength twice": (
        "A = 0.1",
        "A = 0.1\nlambda_over_L = [0.1, 0.2]",
        r":13: parameters.lambda_over_L = \[0.1, 0.2\]: lambda_over_R gives the wavelength already; keep one",
    ),
    "amplitude twice": ("A = 0.1", "A = 0.1\nchi = 0.5", r":13: parameters.chi = 0.5: A gives the amplitude already"),
    "no amplitude": ("A = 0.1\n", "", r":6: parameters.A: .*required; write for example A = 0.1, or instead chi = 0.5"),
    "ratio out of range": ("A = 0.1", "chi = -0.1", r":12: parameters.chi = -0.1: out of range; .*chi >= 0"),
    "ratio not finite": ("A = 0.1", "chi = inf", r":12: parameters.chi = inf: out of range; .*chi >= 0, and finite"),
    "layout unknown": ('layout = "grid"', 'layout = "gird"', r':3: layout = "gird": .*did you mean "grid"'),
    "outputs no list": ('["pull_off_force"]', '"pull_off_force"', r':4: outputs = "pull_off_force": .*a list'),
    "outputs empty": ('["pull_off_force"]', "[]", r":4: outputs = \[\]: the list is empty"),
    "output unknown": (
        '["pull_off_force"]',
        '["pull_of_force"]',
        r':4: outputs\[0\] = .*did you mean "pull_off_force"',
    ),
    "output no string": ('["pull_off_force"]', "[3]", r":4: outputs\[0\] = 3: this must be a string"),
    "output twice": ('["pull_off_force"]', '["delta_max", "delta_max"]', r":4: outputs\[1\] = .*twice; remove"),
    "report of another solver": (
        GOOD[GOOD.index("outputs") :],
        GOOD[GOOD.index("outputs") :].replace("pull_off_force", "energy_gain").replace("exact", "envelope"),
        r':4: outputs\[0\] = "energy_gain": the solver "envelope" has no such output; remove it, or write solver',
    ),
    "solver unknown": ('"exact"', '"exakt"', r':16: method.solver = "exakt": .*did you mean "exact"'),
    "check no truth": (
        'solver = "exact"',
        "check_contact = 0",
        r":16: method.check_contact = 0: this must be true or false",
    ),
    "solver no string": ('"exact"', "1", r":16: method.solver = 1: this must be a string"),
    "method no table": ('layout = "grid"', "method = 3", r":3: method = 3: this must be a table"),
    "outputs misspelt": ("outputs =", "output =", r':4: output = .*did you mean "outputs"'),
    "number as text": ("nu = 0.3", 'nu = "0.3"', r':8: parameters.nu = "0.3": this must be a number'),
    "number as bool": ("nu = 0.3", "nu = true", r":8: parameters.nu = true: this must be a number"),
    "number as date": ("nu = 0.3", "nu = 2020-01-01", r":8: parameters.nu = 2020-01-01: this must be a number"),
    "number nan": ("nu = 0.3", "nu = nan", r":8: parameters.nu = nan: out of range; .* -1 < nu <= 0.5"),
    "number inf": ("modulus = 500.0", "modulus = inf", r":9: parameters.modulus = inf: .*modulus > 0, and finite"),
    "a_max nan": ("R = inf", "R = nan", r":13: parameters.a_max_over_R = nan: out of range"),
    "a_max minus inf": ("R = inf", "R = -inf", r":13: parameters.a_max_over_R = -inf: out of range"),
    "integer of many digits": (
        "modulus = 500.0",
        "modulus = 1" + 400 * "0",
        r":9: parameters.modulus = .*out of range",
    ),
    "list in list": ("[0.0, 0.5]", "[0.0, [0.5]]", r":7: parameters.k\[1\] = \[0.5\]: this must be a number"),
    "bool in list": ("[0.0, 0.5]", "[0.0, true]", r":7: parameters.k\[1\] = true: this must be a number"),
    "nan in list": ("[0.0, 0.5]", "[0.0, nan]", r":7: parameters.k\[1\] = nan: out of range"),
    "empty axis": ("[0.0, 0.5]", "[]", r":7: parameters.k = \[\]: an axis needs at least one value"),
    "repeated value": (
        "[0.0, 0.5]",
        "[0.0, 0.5, 0.0]",
        r":7: parameters.k = .*repeats the value 0.0 \(items 0 and 2\)",
    ),
    "repeated zero": ("[0.0, 0.5]", "[0, -0.0]", r":7: parameters.k = .*repeats the value 0.0"),
    "range without stop": ("stop = 0.5, ", "", r":11: parameters.lambda_over_R.stop: a range needs this key"),
    "range without num": (", num = 3", "", r":11: parameters.lambda_over_R.num: this key is required"),
    "range of none": ("num = 3", "num = 0", r":11: parameters.lambda_over_R.num = 0: .*an integer of 1 or more"),
    "range of a fraction": ("num = 3", "num = 3.0", r":11: parameters.lambda_over_R.num = 3.0: .*an integer"),
    "range of a bool": ("num = 3", "num = true", r":11: parameters.lambda_over_R.num = true: .*an integer"),
    "range of one": ("num = 3", "num = 1", r":11: parameters.lambda_over_R.num = 1: one value cannot be at both"),
    "range of too many": ("num = 3", "num = 1" + 9 * "0", r":11: parameters.lambda_over_R.num = .*split the study"),
    "range of one place": ("stop = 0.5", "stop = 0.1", r":11: parameters.lambda_over_R = .*the value 0.1 repeats"),
    "range finer than numbers": (
        "stop = 0.5, num = 3",
        "stop = 0.10000000000000002, num = 9",
        r":11: parameters.lambda_over_R = .*repeats the value",
    ),
    "range to inf": ("stop = 0.5", "stop = inf", r":11: parameters.lambda_over_R.stop = inf: .*finite"),
    "range unknown key": ("num = 3", "num = 3, base = 2", r":11: parameters.lambda_over_R.base = 2: unknown key"),
    "range unknown spacing": (
        '"log"',
        '"logg"',
        r':11: parameters.lambda_over_R.spacing = "logg": .*did you mean "log"',
    ),
    "range no spacing": ('"log"', "2", r":11: parameters.lambda_over_R.spacing = 2: spacing is"),
    "range out of bounds": ("start = 0.1", "start = -0.1", r":11: parameters.lambda_over_R.start = -0.1: out of range"),
    "log from zero": ("A = 0.1", 'A = { start = 0, stop = 1, num = 3, spacing = "log" }', r":12: .*A.start = 0: log"),
    "no stiffness": ("[0.0, 0.5]", "[0.0, 1.0]", r":7: parameters.k = 1.0: with k = 1 and nu = 0.3 .*use nu = 0.5"),
    "no stiffness in a range": (
        "k = [0.0, 0.5]\nnu = 0.3",
        "k = { start = 0.0, stop = 1.0, num = 4 }\nnu = [0.5, 0.4]",
        r":7: parameters.k = 1.0: with k = 1 and nu = 0.4",
    ),
    "too many scenes": (
        "k = [0.0, 0.5]\nnu = 0.3\nmodulus = 500.0",
        "k = { start = 0, stop = 0.9, num = 100000 }\nnu = { start = 0, stop = 0.4, num = 100000 }\nmodulus = 5",
        r": parameters: a map study has at most 2,147,483,648 scenes, and this one has 30,000,000,000; use fewer",
    ),
    "lists of two lengths": (
        '"grid"',
        '"points"',
        r':11: parameters.lambda_over_R = .*it has 3 values, but k has 2; with layout = "points"',
    ),
    "not TOML": ("kind = ", "kind ", r":2: not valid TOML, .*fix this line"),
    "decimal comma": ("nu = 0.3", "nu = 0,3", r':8: not valid TOML, .* in "nu = 0,3"; write a decimal point, 0\.3$'),
    "decimal comma in a range": (
        "start = 0.1",
        "start = 0,1",
        r":11: not valid TOML, .*; write a decimal point, 0\.1$",
    ),
    "key twice": (
        "nu = 0.3",
        "nu = 0.3\nnu = 0.4",
        r":9: not valid TOML, cannot overwrite .*; the key is given twice, remove one",
    ),
    "table twice": (
        "nu = 0.3",
        "nu = 0.3\n[parameters]",
        r":9: not valid TOML, cannot declare .*; the table is given twice, join the two",
    ),
    "unfinished": ("R = inf", "R = [", r"not valid TOML"),
    "nested too deeply": ("R = inf", "R = " + 3000 * "[", r"not a study, tables or lists are nested more than 32 deep"),
    "digits without end": (
        "R = inf",
        "R = " + 5000 * "1",
        r"not valid TOML, a number of more than 4,300 digits; write it with an exponent",
    ),
}

BOUNDS = {
    "k": ("-0.001", "1.001", "0 <= k <= 1"),
    "nu": ("-1.0", "0.5000000001", "-1 < nu <= 0.5"),
    "modulus": ("0.0", "-5", "modulus > 0"),
    "c0_over_R": ("0", "-1e-300", "c0_over_R > 0"),
    "lambda_over_R": ("0.0", "-1", "lambda_over_R > 0"),
    "A": ("-1e-9", "-inf", "A >= 0"),
    "a_max_over_R": ("0", "-3", "a_max_over_R > 0"),
}


@pytest.fixture
def refused(
    gradhesion: Callable[..., Result], write_study: Callable[[str], Path], tmp_path: Path
) -> Callable[..., list[str]]:
    """Run a text as a study that must be refused, and give the lines of the message."""

    def run(text: str, *arguments: str) -> list[str]:
        path = write_study(text)
        result = gradhesion("run", path, "-o", tmp_path / "out.nc", *arguments)
        assert result.exit_code == 2
        assert not result.stdout
        assert "Traceback" not in result.stderr
        assert [item.name for item in tmp_path.iterdir()] == ["study.toml"], "nothing is written"
        return [line.replace(str(path), "study.toml") for line in result.stderr.splitlines()]

    return run


@pytest.mark.parametrize("name", MISTAKES)
def test_each_mistake_has_its_sentence(name: str, refused: Callable[..., list[str]]) -> None:
    old, new, message = MISTAKES[name]
    assert old in GOOD
    text = GOOD.replace(old, new, 1)
    if "method = 3" in text:
        text = text.replace('[method]\nsolver = "exact"\n', "")
    lines = refused(text)
    assert all(line.startswith("study.toml") for line in lines)
    assert any(re.search("study.toml.*" + message, line) for line in lines), lines


@pytest.mark.parametrize("name", BOUNDS)
@pytest.mark.parametrize("form", ["{}", "[{}]", "{{ start = {}, stop = 0.4, num = 2 }}"])
def test_each_bound_of_each_parameter(name: str, form: str, refused: Callable[..., list[str]]) -> None:
    *outside, allowed = BOUNDS[name]
    for value in outside:
        if "inf" in value and "start" in form:
            continue
        text = re.sub(rf"(?m)^{name} = .*$", f"{name} = {form.format(value)}", GOOD)
        (line,) = refused(text)
        assert f"parameters.{name}" in line
        assert f"= {value.rstrip('0') if '.' in value else value}"[:4] in line
        assert allowed in line


@pytest.mark.parametrize(("k", "nu"), [("0.0", "-0.9999999999999999"), ("1.0", "0.5")])
def test_the_closed_ends_are_allowed(k: str, nu: str, write_study: Callable[[str], Path]) -> None:
    from gradhesion.cli.study.reading import load_study

    study = load_study(write_study(GOOD.replace("[0.0, 0.5]", k).replace("nu = 0.3", f"nu = {nu}")))
    assert study.parameters["k"] == float(k)


@pytest.mark.parametrize("layout", ["grid", "points"])
def test_a_thousand_curves_are_allowed(layout: str, write_study: Callable[[str], Path]) -> None:
    from gradhesion.cli.study.reading import load_study

    text = GOOD.replace(*CURVE).replace("pull_off_force", "path").replace("[0.0, 0.5]", "0.5").replace("grid", layout)
    assert load_study(write_study(text.replace("num = 3", "num = 1000"))).scenes == 1000


@pytest.mark.parametrize("old", ["num = 3", "num = 1001"])
def test_points_are_counted_by_their_longest_list(old: str, refused: Callable[..., list[str]]) -> None:
    text = GOOD.replace(*CURVE).replace("pull_off_force", "path").replace("[0.0, 0.5]", "0.5").replace("grid", "points")
    text = text.replace("num = 3", "num = 1001").replace(
        "nu = 0.3", "nu = [0.1, 0.2]" if old == "num = 3" else "nu = 0.3"
    )
    assert any("at most 1,000 scenes, and this one has 1,001" in line for line in refused(text))


def test_all_mistakes_are_told_at_once_in_the_order_of_their_lines(refused: Callable[..., list[str]]) -> None:
    text = GOOD
    for name in (
        "kind unknown",
        "layout unknown",
        "output unknown",
        "number as text",
        "range unknown key",
        "solver unknown",
    ):
        text = text.replace(*MISTAKES[name][:2])
    text = text.replace("A = 0.1", "A = [0.1, 0.2, 0.1]").replace("[0.0, 0.5]", "[0.0, -2.0, 7.0]")
    lines = refused(text, "--set", "parameters.modulus=-1")
    assert lines[0].startswith("--set parameters.modulus=-1: parameters.modulus = -1: out of range")
    numbers = [int(line.split(":")[1]) for line in lines[1:]]
    assert numbers == [2, 3, 4, 7, 7, 8, 11, 12, 16]


def test_a_misplaced_key_does_not_excuse_a_wrong_one(refused: Callable[..., list[str]]) -> None:
    lines = refused(GOOD.replace('title = "Good"', "title = nan").replace("[method]", 'title = "Good"\n[method]'))
    assert ["title = nan: this must be a string" in lines[0], "belongs at the top" in lines[1]] == [True, True]


def test_a_thousand_mistakes_do_not_flood_the_screen(refused: Callable[..., list[str]]) -> None:
    lines = refused(GOOD.replace("[0.0, 0.5]", str([-1.0 - i for i in range(1000)])))
    assert len(lines) == 31
    assert "970 more mistakes" in lines[-1]


def test_points_name_the_scene_without_stiffness(refused: Callable[..., list[str]]) -> None:
    text = GOOD.replace('"grid"', '"points"').replace("num = 3", "num = 4")
    text = text.replace("[0.0, 0.5]", "[1.0, 0.2, 1.0, 1.0]").replace("nu = 0.3", "nu = [0.5, 0.3, 0.1, 0.2]")
    (line,) = refused(text)
    assert "study.toml:7: parameters.k = 1.0: with k = 1 and nu = 0.1 in scene 2 (and 1 more)" in line


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("parameters.k", "not of the form KEY=VALUE"),
        ("=3", "not of the form KEY=VALUE"),
        ("parameters..k=3", "not of the form KEY=VALUE"),
        ("layout=points", "the value is not TOML; quote strings, as in --set 'layout=\"points\"'"),
        ("parameters.k=", "the value is not TOML"),
        ("parameters.k=0.1\nA=3", "the value is not TOML"),
        ("title.x=3", "title is not a table; set it as a whole"),
        ("parameters.kk=0.1", 'parameters.kk = 0.1: unknown key; did you mean "k"?'),
        ("parameters.k=2", "parameters.k = 2: out of range"),
        ("parameters.lambda_over_R={start=1, stop=2, num=0}", "parameters.lambda_over_R.num = 0: num is"),
        ("parameters.lambda_over_R.num=0", "parameters.lambda_over_R.num = 0: num is"),
        ("nothing.at.all=1", "nothing = { at = { all = 1 } }: unknown key"),
    ],
)
def test_a_wrong_override_is_named_by_its_own_text(
    override: str, message: str, refused: Callable[..., list[str]]
) -> None:
    text = "\n".join(refused(GOOD, "--set", override))
    assert f"--set {printable_line(override)}" in text
    assert message in text


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "cannot be read (No such file or directory)"),
        ("folder", "cannot be read (Is a directory)"),
        (b'title = "\xff"', ":1: not text in UTF-8"),
        (b"\x00\x01\x02", "not valid TOML"),
        (b"\n\n\nk = \n", ":4: not valid TOML"),
    ],
)
def test_a_file_that_is_no_study(
    content: bytes | str | None, message: str, gradhesion: Callable[..., Result], tmp_path: Path
) -> None:
    path = tmp_path / "study.toml"
    if content == "folder":
        path.mkdir()
    elif isinstance(content, bytes):
        path.write_bytes(content)
    result = gradhesion("run", path)
    assert result.exit_code == 2
    assert str(path) in result.stderr
    assert message in result.stderr


def test_an_endless_file_is_not_read_for_ever() -> None:
    from gradhesion.cli.errors import StudyError
    from gradhesion.cli.study.text.source import read_source

    with pytest.raises(StudyError, match="larger than 1 MiB"):
        read_source(Path("/dev/zero"), (), most=2**20)


def test_a_study_made_in_python_is_checked_alike() -> None:
    from gradhesion.cli.errors import StudyError
    from gradhesion.cli.study.reading import study_from

    with pytest.raises(StudyError) as caught:
        study_from({"outputs": ["delta_max"], "parameters": {"k": (0.1, 2.0)}}, name="mine")
    assert caught.value.mistakes[0] == "mine: parameters.k[1] = 2.0: out of range; choose a value with 0 <= k <= 1"
    assert len(caught.value.mistakes) == 6
