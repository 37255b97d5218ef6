"""`gradhesion profile`: measured heights of a punch as the profile of a study, with a picture of the fit."""

from pathlib import Path

import click

from gradhesion.cli.commands import shared


@click.command(epilog=shared.example("profile tip.csv", 'profile tip.csv --up-to "2 um" --exponent fit > punch.toml'))
@click.argument("file", type=shared.A_PATH)
@click.option("-o", "--output", type=shared.A_PATH, help="Picture: .png, .svg or .pdf [FILE.png].")
@click.option("--terms", type=int, default=16, show_default=True, help="Harmonics to fit.")
@click.option("--exponent", default="2.0", show_default=True, help='Power of the punch, or "fit" to fit it.')
@click.option("--up-to", metavar="LENGTH", help='Distance from the centre up to which to fit, as "2 um" [all].')
@shared.overwriting
@shared.quietly
def profile(
    file: Path, output: Path | None, terms: int, exponent: str, up_to: str | None, overwrite: bool, quiet: bool
) -> None:
    """Fit the profile of a punch to measured heights.

    FILE is a table (CSV or NetCDF) with the columns r and height, their units in the header, as r [um]. Fits a power
    and a Fourier series, prints them as tables of a study, and draws the fit.
    """
    path = output or file.with_suffix(".png")
    form = shared.ending_of(path, "picture", shared.OF_PICTURES)

    from gradhesion.cli.disk import replacement, writing
    from gradhesion.cli.errors import StudyError
    from gradhesion.cli.picture.fits import drawn_profile
    from gradhesion.cli.picture.pictured import save
    from gradhesion.cli.study.files import read_profile
    from gradhesion.cli.study.text.quantities import si_value
    from gradhesion.cli.terminal.messages import show_block
    from gradhesion.cli.words.profile_words import tables_of
    from gradhesion.core.answers.profile_fit import fit_profile

    option = f"--up-to {up_to}"
    try:
        reach = None if up_to is None else si_value(up_to, "up_to")
        option = f"--exponent {exponent}"
        power = None if exponent == "fit" else float(exponent)
    except ValueError as error:
        raise click.UsageError(f"{option}: {error}") from None
    with replacement(path, overwrite=overwrite) as temporary:
        try:
            r, heights, _, dropped = read_profile(file)
            fit = fit_profile(r, heights, up_to=reach, terms=terms, exponent=power)
        except ValueError as error:
            raise StudyError(f"{file}: {error}") from None
        with writing(path):
            save(drawn_profile(fit, file.name), temporary, form)
    show_block("\n".join(tables_of(fit, file, terms, power or "fit")))
    if not quiet:
        rows = "row was" if dropped == 1 else "rows were"
        shared.say_written(path, [f"{file}: {dropped:,} {rows} left out, for lack of two numbers"] if dropped else [])
