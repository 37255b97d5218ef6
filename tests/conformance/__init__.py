"""What any solver behind gradhesion.core must satisfy: stored truth, and laws that need no stored value.

A kind is a row of the table in `kinds.py`; a law is a function that holds for every kind it applies to. Everything goes
through `gradhesion.core.solve` and `draw_curves`. Scenes are drawn by a seed that is fixed. Tolerances are what
docs/accuracy.md promises (`promises.py`), not what a solver reaches.

    pytest tests/conformance                                                  all of it
    CONFORMANCE_SEED=7 CONFORMANCE_SCENES=160 pytest tests/conformance        on fresh scenes, and more of each kind
"""
