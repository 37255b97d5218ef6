"""The number of processors that this process may use: of its job, affinity or container, not those of the machine."""

import math
import os
from contextlib import suppress
from pathlib import Path
from typing import Final

_GROUPS: Final = Path("/sys/fs/cgroup")
_GROUP_OF_PROCESS: Final = Path("/proc/self/cgroup")


def processors() -> int:
    """Count the processors that this process may use.

    A job with 4 of 96 processors is bound to these (its affinity); a container may run on all 96 and have the time of 4
    (its quota). More threads than that wait for each other.

    Returns
    -------
    int
        At least 1: the processors of the affinity (Linux, or any system from Python 3.13 on; else of the machine), and
        no more than the quota of the process's control group, rounded up.
    """
    if hasattr(os, "process_cpu_count"):  # from Python 3.13 on; PYTHON_CPU_COUNT overrides it
        bound = os.process_cpu_count()
    elif hasattr(os, "sched_getaffinity"):
        bound = len(os.sched_getaffinity(0))
    else:
        bound = os.cpu_count()
    return max(1, math.ceil(min(bound or 1, _quota())))


def _quota() -> float:
    """Find how many processors' time control groups (of version 2) allow, or inf."""
    allowed = [math.inf]
    with suppress(OSError, ValueError):
        (own,) = [line[3:] for line in _GROUP_OF_PROCESS.read_text().splitlines() if line.startswith("0::")]
        group = _GROUPS / own.strip("/")
        files = [folder / "cpu.max" for folder in (group, *group.parents) if folder.is_relative_to(_GROUPS)]
        allowed += [_share(file.read_text()) for file in files if file.is_file()]
    return min(allowed)


def _share(limit: str) -> float:
    """Read a limit, the time of a group and the period that it is for.

    >>> _share("150000 100000"), _share("max 100000")
    (1.5, inf)
    """
    quota, period = limit.split()
    return math.inf if quota == "max" else float(quota) / float(period)
