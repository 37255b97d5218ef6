"""How a sweep scales with threads, and whether anything of it is serial and grows: `python -m benchmarks.threads`."""

import argparse
from typing import Final

from benchmarks.clock import processors, table
from benchmarks.scale import in_its_own_process, solving

SIZES: Final = (10**5, 10**6, 10**7)
MOST: Final = 16


def counts() -> list[int]:
    """Return 1, 2, 4, ... threads, as many as this machine has processors for."""
    return [count for count in (1, 2, 4, 8, MOST) if count <= max(2, processors())]


def serial_part(one: float, many: float, threads: int) -> float:
    """Return the part of the work that threads do not share, by Amdahl's law: many = one (f + (1 - f)/threads)."""
    return (threads * many / one - 1.0) / (threads - 1.0)


def threads_table(most: int = 10**7) -> str:
    """Return the times of both ways, and the serial part of solving, by the number of scenes."""
    lines = []
    for cells in SIZES:
        if cells > most:
            continue
        alone: dict[int, float] = {}
        for threads in counts():
            alone[threads] = cells * solving(cells, threads)
            whole, _, _ = in_its_own_process(cells, threads)
            part = f"{100 * serial_part(alone[1], alone[threads], threads):.1f} %" if threads > 1 else "-"
            lines.append([cells, threads, alone[threads], alone[1] / alone[threads], part, whole])
    return table(["scenes", "threads", "solving, s", "times as fast", "serial part", "to a closed file, s"], lines)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--most", type=int, default=10**7, help="the largest number of scenes")
    print(threads_table(parser.parse_args().most))


if __name__ == "__main__":
    main()
