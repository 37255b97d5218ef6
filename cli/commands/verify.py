"""`gradhesion verify`: a sample of a dataset recomputed at high precision, by other means."""

from pathlib import Path

import click

from gradhesion.cli.commands.shared import A_PATH, example, given_up
from gradhesion.cli.errors import DoubtfulError
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.messages import show
from gradhesion.cli.terminal.progress import progress


@click.command(epilog=example("verify outputs/study.nc --sample 50"))
@click.argument("file", type=A_PATH)
@click.option("--sample", type=click.IntRange(min=1), default=20, show_default=True, help="Scenes to recompute.")
@click.option("--seed", type=click.IntRange(min=0), help="Seed of the random sample [random].")
@given_up("--digits", "in Python, gr.verify(FILE).deviations has each value beside the one recomputed")
def verify(file: Path, sample: int, seed: int | None) -> None:
    """Recompute maps to 30 digits and compare.

    The study stored in FILE must be unchanged and match its coordinates. A random sample of the scenes is then solved
    from the integral definitions, in 51-digit arithmetic and without the kernels that made the dataset. The deviations
    are printed, largest first. A scene usually takes less than 0.1 s, and at most 15 s: scenes of more than 1,000
    waves, or fewer for a series of many harmonics, are replaced by others.

    The exit code is 3 if a value deviates by more than its stated error.
    """
    from gradhesion.cli.dataset.read.reader import opened
    from gradhesion.cli.dataset.verify import in_words, recompute

    with opened(file) as dataset:
        found = recompute(dataset, file, sample=sample, seed=seed, progress=lambda total: progress(total, quiet=False))
        title = str(dataset.attrs["title"])
    for line in in_words(found, title, file):
        show(line)
    if found.exceeding:
        raise DoubtfulError(
            f"{file}: {found.exceeding:,} of {counted(len(found.deviations), 'value')} deviate by more than their "
            "stated errors; write it again with `gradhesion run`, and report it if they still do"
        )
