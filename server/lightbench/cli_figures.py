"""The command that draws comparison figures: `figures`."""

import io
from pathlib import Path

import click

from lightbench.cli_options import folders

__all__ = ["figures"]


@click.command()
@click.argument("folder", metavar="[DIR]", default="figures", type=click.Path(path_type=Path))
@click.option("--only", metavar="NAME", multiple=True, help="As 3.1; again for others.")
@click.option("--list", "as_list", is_flag=True, help="Name the figures and draw none.")
@folders
def figures(folder: Path, only: tuple[str, ...], as_list: bool) -> None:
    """Draw the comparison figures, each a sheet DIR/figure-NAME.png; DIR is `figures` here."""
    from lightbench import figures as all_figures

    found = {name: all_figures.figure(name) for name in only or all_figures.names()}
    for name, figure in found.items():
        path = f"{name:<6}" if as_list else _drawn(folder, name)
        click.echo(f"{path}  {figure.title if as_list else figure.caption}")


def _drawn(folder: Path, name: str) -> Path:
    from PIL import Image as Pillow

    from lightbench.figure_sheet import sheet
    from lightbench.figures import figure
    from lightbench.image import write_whole

    buffer = io.BytesIO()
    Pillow.fromarray(sheet(name, figure(name))).save(buffer, "PNG", optimize=True)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"figure-{name}.png"
    write_whole(path, buffer.getvalue())
    return path
