"""The digest of the sources."""

from pathlib import Path

from gradhesion.core.compiler.sources import COMPILED, CORE, SOURCES, WITHOUT_KERNELS, digest_of


def test_the_digest_follows_every_source(tmp_path: Path) -> None:
    (tmp_path / "inner").mkdir()
    (tmp_path / "one.py").write_text("a = 1\n")
    (tmp_path / "inner" / "two.py").write_text("b = 2\n")
    digests = [digest_of(tmp_path)]
    assert digest_of(tmp_path) == digests[0]
    (tmp_path / "inner" / "two.py").write_text("b = 3\n")
    digests.append(digest_of(tmp_path))
    (tmp_path / "inner" / "two.py").rename(tmp_path / "inner" / "three.py")
    digests.append(digest_of(tmp_path))
    (tmp_path / "four.py").touch()
    digests.append(digest_of(tmp_path))
    assert len(set(digests)) == 4


def test_it_is_that_of_the_core() -> None:
    assert digest_of(CORE) == SOURCES
    assert (CORE / "sweep.py").is_file()


def test_what_compiled_code_depends_on(tmp_path: Path) -> None:
    for room in WITHOUT_KERNELS:
        assert [source for source in (CORE / room).rglob("*.py") if "core.compiler.jit" in source.read_text()] == []
    (tmp_path / "answers").mkdir()
    (tmp_path / "one.py").touch()
    digest = digest_of(tmp_path, WITHOUT_KERNELS)
    (tmp_path / "answers" / "fit.py").touch()
    assert digest_of(tmp_path, WITHOUT_KERNELS) == digest != digest_of(tmp_path)
    assert digest_of(CORE, WITHOUT_KERNELS) == COMPILED
