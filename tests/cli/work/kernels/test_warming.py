"""Which process compiles what: each kind once, after those that it needs, by the one that has most of it already."""

import random

import pytest

from gradhesion.cli.work.kernels.warming import next_kind
from gradhesion.core import APART, KERNELS, KINDS, NEEDS
from gradhesion.core.kinds import before


def scheduled(workers: int, draw: random.Random) -> list[tuple[int, str]]:
    """Give kinds to processes that end in any order, and check each choice."""
    left, running, behind = [*KINDS], {}, [set[str]() for _ in range(workers)]
    found: list[tuple[int, str]] = []
    while left or running:
        for worker in range(workers):
            if worker not in running and (kind := next_kind(left, [*running.values()], behind[worker])):
                assert {*NEEDS[kind]} <= {done for each in behind for done in each}
                assert not any({kind, other} in APART for other in running.values())
                left.remove(kind)
                running[worker] = kind
                found.append((worker, kind))
        assert running, "nobody does anything"
        worker = draw.choice([*running])
        behind[worker].add(running.pop(worker))
    return found


@pytest.mark.parametrize("workers", [1, 2, 5])
def test_each_kind_is_compiled_once_after_those_that_it_needs(workers: int) -> None:
    for seed in range(20):
        found = scheduled(workers, random.Random(seed))
        assert sorted(kind for _, kind in found) == sorted(KINDS)


def test_a_process_goes_on_with_what_it_has() -> None:
    left = ["reports", "turning", "general_reports", "general_turning"]
    assert next_kind(left, [], {"tables", "energy"}) in {"reports", "turning"}
    assert next_kind(left, [], {"tables", "general_energy"}) in {"general_reports", "general_turning"}


def test_first_comes_what_most_others_wait_for() -> None:
    left = [kind for kind in KINDS if kind != "tables"]
    first = next_kind(left, [], {"tables"})
    waiting = {kind: sum(KERNELS[other] for other in left if kind in before(other)) for kind in left}
    assert waiting[first] == max(waiting[kind] for kind in left if not {*NEEDS[kind]} & {*left})


def test_of_equals_the_longest_comes_first() -> None:
    left = ["general_reports", "general_sensitivities", "general_turning"]
    assert next_kind(left, [], {"tables", "general_energy"}) == "general_sensitivities"


def test_nothing_may_be_begun() -> None:
    assert next_kind(["reports"], ["energy"], set()) == ""
    assert next_kind(["force"], ["sensitivities"], {"tables"}) == "", "they compile entries of the same name"
    assert next_kind([], [], set()) == ""
