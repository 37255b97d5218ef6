"""What a file is, by how it begins and by its name."""

from pathlib import Path

import pytest

from gradhesion.cli.files import kind_of


@pytest.mark.parametrize(
    ("name", "content", "kind"),
    [
        ("x.toml", b"\x89HDF\r\n\x1a\n", "a dataset (NetCDF or HDF5)"),
        ("x", b"CDF\x01", "a dataset (NetCDF)"),
        ("x.nc", b"\x89PNG\r\n", "a picture (PNG)"),
        ("x.CSV", b"k,nu", "a table (CSV)"),
        ("x.toml", b"k = 1", "a study (TOML)"),
        ("x", b"k = 1", ""),
        ("x", b"", ""),
    ],
)
def test_a_file(name: str, content: bytes, kind: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(content)
    assert kind_of(tmp_path / name) == kind


def test_what_is_no_file(tmp_path: Path) -> None:
    assert kind_of(tmp_path) == "a directory"
    assert kind_of(Path("/dev/null")) == "no regular file"
    assert kind_of(tmp_path / "none.toml") == ""
    assert kind_of(Path("x\0y")) == ""
