"""The command that fits a display's gamma: `gamma`."""

import click

from lightbench.errors import LightbenchError

__all__ = ["gamma"]

Measured = tuple[float, float]


def _measured(
    _context: click.Context, _option: click.Parameter, values: tuple[str, ...]
) -> list[Measured]:
    return [_point(value) for value in values]


def _point(text: str) -> Measured:
    try:
        level, luminance = map(float, text.split("="))
    except ValueError:
        raise LightbenchError(f"'{text}' is not LEVEL=LUMINANCE, such as 128=21.5") from None
    return level, luminance


# A level below 0 is a wrong level and no option.
@click.command(context_settings={"ignore_unknown_options": True})
@click.argument("measured", metavar="LEVEL=LUMINANCE...", nargs=-1, callback=_measured)
def gamma(measured: list[Measured]) -> None:
    """Fit y = x^gamma to what a luminance meter says of a display.

    Levels are codes 0 to 255 or shares 0 to 1, white among them; luminances have any unit. The
    scene lab/calibration-chart shows five levels. The result is for --set transfer=gamma --set
    gamma=VALUE.
    """
    from lightbench.gamma import fit, table

    click.echo(table(fit(measured)))
