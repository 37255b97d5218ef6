"""Numbers of things and of bytes, as messages write them."""


def counted(number: int, noun: str) -> str:
    """
    Write a number of things.

    >>> counted(1, "scene"), counted(1200, "scene"), counted(0, "block")
    ('1 scene', '1,200 scenes', '0 blocks')
    """
    return f"{number:,} {noun}" + ("" if number == 1 else "s")


def bytes_in_words(number: float) -> str:
    """
    Write a number of bytes in the unit that fits.

    >>> bytes_in_words(2.5e9), bytes_in_words(300)
    ('2.5 GB', '0.3 kB')
    """
    unit, size = next((pair for pair in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6)) if number >= pair[1]), ("kB", 1e3))
    return f"{number / size:,.1f} {unit}"
