"""Numbers of things and of bytes, as messages write them."""


def counted(number: int, noun: str) -> str:
    """Write a number of things.

    >>> counted(1, "scene"), counted(1200, "scene"), counted(0, "block")
    ('1 scene', '1,200 scenes', '0 blocks')
    """
    return f"{number:,} {noun}" + ("" if number == 1 else "s")


def bytes_in_words(number: float) -> str:
    """Write a number of bytes in the unit that fits.

    >>> bytes_in_words(2.5e9), bytes_in_words(300)
    ('2.5 GB', '0.3 kB')
    """
    unit, size = next((pair for pair in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6)) if number >= pair[1]), ("kB", 1e3))
    return f"{number / size:,.1f} {unit}"


def share_of(count: int, scenes: int) -> str:
    """Write how many of some scenes, with their share to two digits.

    >>> share_of(1, 6), share_of(6, 6), share_of(1, 3000)
    ('1 of 6 scenes (17 %)', '6 of 6 scenes (100 %)', '1 of 3,000 scenes (0.033 %)')
    """
    share = 100.0 * count / scenes
    return f"{count:,} of {counted(scenes, 'scene')} ({share:.{3 if share >= 99.5 else 2}g} %)"


def duration(seconds: float) -> str:
    """Write a time in the unit that fits.

    >>> duration(0.31), duration(75.0), duration(1e4), duration(float("inf"))
    ('0.3 s', '75 s', '2.8 h', 'any time')
    """
    if seconds > 1e9:
        return "any time"
    for unit, size, most in (("s", 1.0, 120.0), ("min", 60.0, 7200.0), ("h", 3600.0, 172_800.0)):
        if seconds < most:
            return f"{seconds / size:.{0 if seconds / size >= 10 else 1}f} {unit}"
    return f"{seconds / 86_400:.0f} d"
