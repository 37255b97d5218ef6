"""Examples at the end of the help of commands."""


def example(*calls: str) -> str:
    r"""
    Write calls of the program below each other, as click leaves them.

    >>> example("init", "init curve")
    '\x08\nExamples:\n  gradhesion init\n  gradhesion init curve'
    """
    head = "Example:" if len(calls) == 1 else "Examples:"
    return "\n".join(["\b", head, *(f"  gradhesion {call}" for call in calls)])
