"""Columns of numbers are read from text and NetCDF; wrong ones are a sentence with file, line, column and remedy."""

import hashlib
import os
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import gradhesion as gr
from gradhesion.cli.picture.curves import read_points
from gradhesion.cli.tables import reading
from gradhesion.cli.tables.columns import ColumnsError, Wanted
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.tables.text import of_text
from tests.cli.conftest import BALL, COLUMNS, PROFILE, Call
from tests.conftest import mistakes


def written(folder: Path, text: str | bytes) -> Path:
    path = folder / "table.csv"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


TEXTS = [
    "A,R [um]\n0.5,1e3\ninf,-2\n",
    "\ufeff# a comment\n\nA ; R (um)\r\n0.5;1e3\r\n# another\r\ninf;-2",
    "  A   R [um]\n 0.5  1e3\n inf -2 # behind\n",
    '"A","R [um]"\n"0.5","1e3"\n"inf","-2"\n',
    "A;R [um]\n0,5;1000\ninf;-2\n",
    "A\tR [um]\n0,5\t1e3\ninf\t-2\n",
    'A,R [um]\n"0,5","1000"\n"inf","-2"\n',
    "sep=;\nA;R [um]\n0,5;1000\ninf;-2\n",
    "A,R\n-,um\n0.5,1000\ninf,-2\n",
    "A;R;\n;[um];\n0,5;1000;\ninf;-2;\n",
    "A,R [um]\n0.5,1000,,\n\n,\ninf,-2\n",
    "A;R [um];\r0.5;1000;\rinf;-2;\r",
    "A [-],R [um] # comment, and more\n0.5,1000 # comment, and more\ninf,-2\n",
    '"A" "R [um]"\n0.5 1000\ninf -2\n',
    "# A,R [um]\n0.5,1000\ninf,-2\n",
    "# an export\n#\n# columns: A R [um]\n# of 2 rows, as written\n0.5 1000\ninf -2\n",
    "A;R [um]\n0,5;1000\ninf;-2\n".encode("utf-16"),
    "A,R [um]\n.5,+1e+3\ninf,-20E-1\n".encode("utf-32"),
]


@pytest.mark.parametrize("text", TEXTS)
def test_what_a_spreadsheet_or_an_instrument_writes_is_read_with_its_units(text: str | bytes, tmp_path: Path) -> None:
    found = read_columns(path := written(tmp_path, text))
    assert {name: values.tolist() for name, values in found.values.items()} == {"A": [0.5, np.inf], "R": [1e3, -2.0]}
    assert found.units == {"R": "um"}
    assert found.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize("cell", ["", "nan", " ", "#N/A", "#DIV/0!", '""'])
def test_a_cell_without_a_number_is_missing(cell: str, tmp_path: Path) -> None:
    found = read_columns(written(tmp_path, f"A,k\n1,{cell}\n{cell},2\n"))
    np.testing.assert_array_equal(np.column_stack([*found.values.values()]), [[1.0, np.nan], [np.nan, 2.0]])


def test_what_is_not_read_may_be_anything_but_ragged(tmp_path: Path) -> None:
    text = ',A,note,note\n7,1,"a, b",\n8,2,\u00b5,#c\n'
    found = read_columns(written(tmp_path, text), only=["A", "k"])
    assert (found.values["A"].tolist(), found.others) == ([1.0, 2.0], ("", "note", "note"))


@given(hnp.arrays(np.float64, st.tuples(st.integers(1, 20), st.integers(1, 5)), elements=st.floats(width=64)))
def test_every_number_comes_back_and_quotes_change_none(table: np.ndarray) -> None:
    rows = [",".join(f"c{i}" for i in range(table.shape[1])), *(",".join(map(repr, row)) for row in table.tolist())]
    for text in ("\n".join(rows), "\n".join([*rows, '"",'])):
        found = of_text(text.encode(), "", Wanted())
        np.testing.assert_array_equal(np.column_stack(list(found.values.values())), table)


MISTAKES = {
    "": "is empty",
    " \n\t\n": "is empty",
    "# only\n": "comments only",
    "A,,k\n1,2,3\n": "column 2 of the header on line 1 has no name",
    "A\n1\n2 mm\n": "line 3 has 2 values under 1 name;",
    b"\x89HDF\r\n\x1a\nbroken": "cannot be read as NetCDF",
    "A," + 2**15 * "[" + "\n1,2\n": "line 1 is too long for a header, 32,771 characters",
}
"""Besides TABLES."""


def test_what_is_no_table_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for text, words in MISTAKES.items():
        with pytest.raises(ColumnsError) as caught:
            read_columns(written(tmp_path, text))
        assert words in str(caught.value)
        assert ";" in str(caught.value), "what to do"
    for path in (tmp_path / "absent.csv", tmp_path, tmp_path / "\0.csv", Path("/dev/zero")):
        with pytest.raises(ColumnsError, match="cannot be read"):
            read_columns(path)
    monkeypatch.setattr(reading, "MOST_BYTES", 100)
    with pytest.raises(ColumnsError, match="larger than"):
        read_columns(written(tmp_path, "A\n" + 100 * "1\n"))


def test_netcdf_has_variables_of_one_dimension(tmp_path: Path) -> None:
    path = tmp_path / "table.nc"
    with netCDF4.Dataset(path, "w") as file:
        file.createDimension("row", 3)
        file.createVariable("A", "f8", ("row",))[:] = [1.0, 2.0, 2.5]
        file.createVariable("n", "i8", ("row",), fill_value=-1)[:] = [2**52 + 1, -1, 2**52]
        file.createVariable("way", str, ("row",))[:] = np.array(["in", "out", "In"], object)
        file.createVariable("one", "f8", ())[...] = 1.0
        file["A"].units = "nm"
    found = read_columns(path, words={"way": {"in": 0.0, "out": 1.0}}, whole=["n"])
    assert found.values.pop("way").tolist() == [0.0, 1.0, 0.0]
    for one in (found, read_columns(path)):
        assert one.values.keys() == {"A", "n"}
        assert one.units == {"A": "nm"}
        np.testing.assert_array_equal(one.values["n"], [2.0**52 + 1, np.nan, 2.0**52])  # with all digits
    with pytest.raises(
        ColumnsError, match=r'row 2, .*: A = "2.5" is not a whole number of at most 15 digits; write one'
    ):
        read_columns(path, whole=["A"])
    with netCDF4.Dataset(path, "a") as file:
        file.createDimension("other", 2)
        file.createVariable("b", "f8", ("other",))[:] = 0.0
    with pytest.raises(ColumnsError, match="differ in length"):
        read_columns(path)
    with netCDF4.Dataset(path, "w") as file:
        file.createVariable("one", "f8", ())[...] = 1.0
    with pytest.raises(ColumnsError, match="no variable of numbers"):
        read_columns(path)


STUDIES = {
    "points": 'outputs = ["pull_off_force"]\n[parameters]\npoints = "table.csv"\nk = 0.0\nnu = 0.3\nlambda_over_R = 0.1\n',
    "fit": f"""kind = "fit"
[data]
file = "table.csv"
{COLUMNS}{BALL}work_of_adhesion = "30 mJ/m^2"
""",
    "profile": PROFILE,
}
"""For each reader of a study a study, whose table has the columns x and y."""
HEADS = {"points": ("modulus", "A", ""), "fit": ("depth", "force", " [nm]"), "profile": ("r", "height", " [nm]"), "data": ("depth", "load", " [nm]")}  # fmt: skip

TABLES: dict[str, tuple[str, str]] = {
    "short row": ("@x,@y\n1,2\n\n# more\n3\n", "line 5 has 1 value under 2 names; give each row one value per column"),
    "decimal commas between commas": ("@x,@y\n1,5,2,3\n", "line 2 has 4 values under 2 names; if its numbers have decimal commas, write points"),
    "decimal commas beside words": ("@x,@y,branch\n1,5,2,25,approach\n", "line 2 has 5 values under 3 names; if its numbers have decimal commas, write points"),
    "commas in words": ("@x,@y,note\n1.5,2,a,b\n", "line 2 has 4 values under 3 names; give each row one value per column"),
    "decimal commas under unnamed columns": ("@x,@y,,\n1,5,2,3\n", "line 2 has 4 values under 2 names; if its numbers have decimal commas"),
    "decimals or thousands": ("@x;@y\n1,234;2\n", 'line 2: @x = "1,234" may be a decimal or thousands'),
    "commas and points": ("@x;@y\n1.5;2\n3;2,25\n", "line 3 has a comma and line 2 a point in a number; write points for the decimals"),
    "overflow": ("@x,@y\n1,-1e400\n", 'line 2: @y = "-1e400" is beyond 1.8e308, the largest number; write it in a larger unit'),
    "Windows text": ("@x,@y,\u00b5\n1,2,3\n", "the file is not text in UTF-8; save it as UTF-8, in a spreadsheet as CSV UTF-8"),
    "cut UTF-16": ("@x,@y\n1,2\n", "the file is not text in UTF-8; save it"),
    "binary": ("\x7fELF\0\0\1", "the file is not text; name a table of numbers in CSV or NetCDF"),
    "workbook": ("PK\x03\x04\x14\0", "the file is an archive (ZIP, or a workbook), not a table; name a table"),
    "header alone": ("@x,@y\n# none\n", "the header on line 1 has no row of numbers below it; add one"),
    "no header": ("1,2\n3,4\n", "line 1 has numbers where the names of the columns are expected; add a header line"),
    "a comment of other words": ("# one two three\n1,2\n", "line 2 has numbers where the names of the columns are expected; add a header line"),
    "one name twice": ("@x,@y,@x\n1,2,3\n", 'columns 1 and 3 of the header on line 1 have one name, "@x"; rename one'),
    "long cell": ('@x,@y\n1,"' + 140_000 * "9" + '"\n', "line 2 has a cell of more than 131,072 characters; shorten it"),
    "long line": ("@x,@y\n1," + 10**6 * "x" + "\n", f'line 2: @y = "{75 * "x"} ... is not a number; write one'),
    "row of units and no more": ("@x,@y\n" * 2, "is not a number; write one"),
}  # fmt: skip
"""Texts with @x and @y in the place of the columns that a reader wants, and what is said."""

for cell in ("1.234,5", "1 234", "0x1F", "1.5D-3", "\u22125", "2 nN", "lost", "1_000"):
    TABLES[cell] = (f"@x\t@y\n1\t{cell}\n", f'line 2: @y = "{cell}" is not a number; write one')
ENCODINGS = {"Windows text": "cp1252", "cut UTF-16": "utf-16"}

OWN: dict[str, tuple[str, str, str]] = {
    "fit: unit of the study": ("fit", "depth [um],force\n1,2\n", 'the unit of the column "depth" is "nm" in the study and "um" in the header of the file; correct one'),
    "fit: no column": ("fit", "dept,force\n1,2\n", 'the file has no column "depth"; did you mean "dept"?'),
    "points: empty cell": ("points", "modulus,A\n1,0.1\n500,\n", "line 3: A is missing (NaN); give it, or remove the row"),
    "points: error of a spreadsheet": ("points", "modulus,A\n1,#N/A\n", "line 2: A is missing (NaN); give it, or remove the row"),
    "points: unit of a ratio": ("points", "modulus [MPa],A\n1,0.1\n", 'the column "modulus": "MPa" is not a unit of this quantity; a number without a unit is expected'),
    "profile: no unit": ("profile", "r [um],height [V]\n1,2\n", 'the column "height": "V" is not a unit of this quantity; a length (m) is expected'),
    "data: no unit": ("data", "depth [nm],load\n1,2\n", "in brackets, as load ["),
    "data: one column": ("data", "depth [nm]\n1\n", 'indentation and load, and it has "depth"; rename some'),
    "data: other names": ("data", "depht;laod\n1,5;2\n", 'it has "depht", "laod"; rename some'),
}  # fmt: skip
"""Wrong for one reader."""
TWO_READERS = [(name, [*HEADS][(i + j) % 4]) for i, name in enumerate(TABLES) for j in (0, 2)]
WORDS = [("loading", "Unloading"), ("approach", "retract"), ("0", "1"), ("0.0", "1.0"), ("false", "TRUE"), ("forward", "Backward"), ("Approaching", "retracting"), ("extend", "withdraw")]  # fmt: skip


def told(reader: str, folder: Path, gradhesion: Call) -> str:
    """Say what a reader says to the wrong table in a folder."""
    if reader == "data":
        (sentence,) = mistakes(read_points, folder / "table.csv", [("indentation", "load")], si=True)
        beginning = f"--data {folder / 'table.csv'}: "
    else:
        study = folder / f"{reader}.toml"
        study.write_text(STUDIES[reader])
        result = gradhesion("validate", study, code=2)
        sentences = result.stderr.splitlines()
        assert len(sentences) == 1, sentences
        sentence, beginning = sentences[0], f"{study}:"
        assert '"table.csv": ' in sentence or " = {" in sentence
    assert sentence.startswith(beginning)
    assert "\n" not in sentence
    return sentence.replace(str(folder), "")


@pytest.mark.parametrize(("name", "reader"), TWO_READERS)
def test_a_wrong_table_is_one_sentence(name: str, reader: str, gradhesion: Call, tmp_path: Path) -> None:
    """Each by two of the four readers, which read tables by the same functions."""
    text, words = TABLES[name]
    x, y, unit = HEADS[reader]
    text = text.replace("@x", x + unit).replace("@y", y + unit.replace("m", "N" if y in ("force", "load") else "m"))
    content = text.encode(ENCODINGS.get(name, "utf-8"))
    written(tmp_path, content[:-1] if name == "cut UTF-16" else content)
    assert words.replace("@x", x).replace("@y", y) in told(reader, tmp_path, gradhesion)


@pytest.mark.parametrize("name", OWN)
def test_what_is_wrong_for_one_reader_is_one_sentence(name: str, gradhesion: Call, tmp_path: Path) -> None:
    reader, text, words = OWN[name]
    written(tmp_path, text)
    assert words in told(reader, tmp_path, gradhesion)


@pytest.mark.parametrize("reader", HEADS)
def test_what_is_no_file_is_one_sentence(reader: str, gradhesion: Call, tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    path.mkdir()
    assert "the file cannot be read (it is a directory); name a table" in told(reader, tmp_path, gradhesion)
    path.rmdir()
    os.mkfifo(path)
    assert "the file cannot be read (it is no regular file); name a table" in told(reader, tmp_path, gradhesion)
    path.unlink()
    path.symlink_to(path)
    assert "the file cannot be read (" in told(reader, tmp_path, gradhesion)


@pytest.mark.parametrize("cell", ["0.6", "inf", "1e20", "first", "unloadng", "3", "0.5"])
def test_wrong_cycles_and_branches_are_one_sentence(cell: str, tmp_path: Path) -> None:
    column = "branch" if cell in ("unloadng", "3", "0.5") else "cycle"
    with pytest.raises(gr.StudyError, match=f'^[^\n]*line 2: {column} = "{cell}" is [^\n]*;[^\n]*$'):
        loop(tmp_path, f"depth,force,{column}\n1,2,{cell}\n", column)


def loop(tmp_path: Path, text: str, *names: str, study: str = STUDIES["fit"]) -> Any:
    """Read a table whose columns of some names are what they say."""
    data = "".join(f'{name} = "{name}"\n' for name in names)
    (tmp_path / "fit.toml").write_text(study.replace("[parameters]", data + "[parameters]"))
    written(tmp_path, text)
    return gr.load(tmp_path / "fit.toml").loop


@pytest.mark.parametrize("numbers", [("3000000001", "5000000002"), ("-5", "2.0")])
def test_cycles_are_whole_numbers(numbers: tuple[str, str], tmp_path: Path) -> None:
    ways = [(0, 1), (1, 3), (2, 2), (1, 1)]
    rows = "".join(f"{depth},{force},{number}\n" for number in numbers for depth, force in ways)
    found = loop(tmp_path, "depth (nanometer),force (nanonewton),cycle\n" + rows, "cycle")
    assert found.cycles == 2
    assert found.cycle.tolist() == [int(float(number)) for number in numbers for _ in ways]
    assert found.unloading.tolist() == 2 * [False, False, False, True]
    assert found.depth.tolist()[:4] == [0.0, 1e-9, 2e-9, 1e-9]


@pytest.mark.parametrize("words", WORDS)
def test_branches_are_words_or_0_and_1(words: tuple[str, str], tmp_path: Path) -> None:
    rows = "".join(f"{i},{i},{words[i % 2]}\n" for i in range(8))
    found = loop(tmp_path, "depth,force,branch\nnm,nN,\n" + rows, "branch")
    assert found.unloading.tolist() == 4 * [False, True]


@pytest.mark.parametrize("rises", [False, True])
def test_branches_may_stand_side_by_side(rises: bool, tmp_path: Path) -> None:
    """Whichever way the rows of retraction go, and though it has fewer of them."""
    back = [(1.0, 2.0), (0.0, -1.0)]
    back = [*(back[::-1] if rises else back), ("", "")]
    there = [(0, 0), (0.5, 1), (1, 3)]
    rows = "".join(f"{one},{two},{three},{four}\n" for (one, two), (three, four) in zip(there, back, strict=True))
    text = STUDIES["fit"]
    for name in ("depth", "force"):
        text = text.replace(f'column = "{name}"', f'column = "{name}", back = "{name}_back"')
    found = loop(tmp_path, "depth,force,depth_back,force_back\n" + rows, study=text)
    np.testing.assert_allclose(found.depth, np.array([0.0, 0.5, 1.0, 1.0, 0.0]) * 1e-9, rtol=1e-15)
    np.testing.assert_allclose(found.load, np.array([0.0, 1.0, 3.0, 2.0, -1.0]) * 1e-9, rtol=1e-15)
    assert found.unloading.tolist() == [False, False, False, True, True]


def test_a_file_of_a_study_may_be_anywhere(gradhesion: Call, tmp_path: Path) -> None:
    (tmp_path / "outside.csv").write_text("modulus,A\n500,0.1\n")
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "link.csv").symlink_to(tmp_path / "outside.csv")
    for name in ("../outside.csv", tmp_path / "outside.csv", "link.csv"):
        (tmp_path / "in" / "s.toml").write_text(STUDIES["points"].replace("table.csv", str(name)))
        assert gradhesion("validate", tmp_path / "in" / "s.toml").exit_code == 0
