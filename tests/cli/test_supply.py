"""What is handed out next, and what is given up: no block is lost, none comes back for ever, none takes others along."""

import random

import pytest

from gradhesion.cli.engines.supply import RETURNS, Supply


def test_every_block_once_in_order() -> None:
    supply, taken = Supply(range(7)), []
    while supply:
        numbers, alone = supply.take(threads=2, flying=len(taken))
        assert not alone
        taken += numbers
    assert taken == list(range(7))
    assert supply.take(threads=2, flying=0) == ((), False)


def test_short_blocks_come_together_but_the_last_are_shared() -> None:
    supply = Supply(range(1000))
    assert len(supply.take(threads=4, flying=0)[0]) == 1, "nothing is known yet"
    supply.done(10, seconds=1.0)
    assert len(supply.take(threads=4, flying=0)[0]) == 20, "two seconds of them"
    sizes = []
    while supply:
        sizes.append(len(supply.take(threads=4, flying=0)[0]))
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[-16:] == [1] * 16
    supply = Supply(range(1000))
    supply.done(1, seconds=30.0)
    assert len(supply.take(threads=4, flying=0)[0]) == 1


def test_suspects_wait_until_nothing_else_flies() -> None:
    supply = Supply(range(3))
    (first, _), (second, _) = supply.take(threads=1, flying=0), supply.take(threads=1, flying=1)
    assert supply.killed(first + second, alone=False) == ()
    assert supply.take(threads=1, flying=0) == ((2,), False)
    assert supply.take(threads=1, flying=1) == ((), False)
    assert supply.take(threads=1, flying=0) == ((0,), True)
    assert supply.killed((0,), alone=True) == (0,)
    assert supply.take(threads=1, flying=0) == ((1,), True)
    assert not supply


def test_what_comes_back_is_tried_a_bounded_number_of_times() -> None:
    supply = Supply([4])
    for _ in range(RETURNS):
        assert supply.take(threads=1, flying=0)[0] == (4,)
        assert supply.back((4,)) == ()
    supply.take(threads=1, flying=0)
    supply.again((4,))
    assert supply.take(threads=1, flying=0)[0] == (4,), "nobody had tried it"
    assert supply.back((4,)) == (4,)
    assert not supply


@pytest.mark.parametrize("seed", range(20))
def test_only_the_guilty_are_given_up(seed: int) -> None:
    """A fleet of workers with queues: blocks that kill them, and other accidents that come now and then."""
    draw = random.Random(seed)
    guilty = set(draw.sample(range(60), 4))
    supply, done, given_up = Supply(range(60)), set(), set()
    queue: list[tuple[tuple[int, ...], bool]] = []
    for _ in range(10_000):
        while len(queue) < 5 and (taken := supply.take(threads=2, flying=len(queue)))[0]:
            queue.append(taken)
        if not queue:
            break
        numbers, alone = queue.pop(0)
        if guilty & {*numbers}:
            lost = [(numbers, alone), *queue[: draw.randrange(3)]]
            del queue[: len(lost) - 1]
            for one, was_alone in lost:
                given_up.update(supply.killed(one, alone=was_alone))
        elif draw.random() < 0.05:
            given_up.update(supply.back(numbers))
        else:
            done.update(numbers)
            supply.done(len(numbers), seconds=0.7 * len(numbers))
    assert given_up == guilty
    assert done == {*range(60)} - guilty
