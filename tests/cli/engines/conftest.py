"""What the tests of the Dask engine share: a study of six blocks, and workers under orders."""

from collections.abc import Iterator
from pathlib import Path

import dask
import pytest

from tests.cli.engines.orders import ByHand, Call, Orders, values_of


@pytest.fixture(autouse=True)
def _small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cut the small study of 24 scenes into 6 blocks."""
    monkeypatch.setenv("GRADHESION_CHUNK", "2")


@pytest.fixture(scope="module")
def orders(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Orders]:
    """Orders that workers of this process's clusters obey."""
    orders = Orders(tmp_path_factory.mktemp("orders"))
    with dask.config.set(
        {
            "distributed.worker.preload": [str(orders.preload)],
            "distributed.scheduler.allowed-failures": 0,
            "distributed.worker.profile.enabled": False,
        }
    ):
        yield orders


@pytest.fixture
def by_hand(tmp_path: Path, orders: Orders) -> Iterator[ByHand]:
    cluster = ByHand(tmp_path, orders)
    yield cluster
    cluster.end()


@pytest.fixture
def whole(gradhesion: Call, study_file: Path, tmp_path: Path) -> dict[str, bytes]:
    """What threads give."""
    path = tmp_path / "whole.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    return values_of(path)


@pytest.fixture
def output(tmp_path: Path) -> Path:
    return tmp_path / "data" / "out.nc"
