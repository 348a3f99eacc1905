"""The commands that measure shader functions: `atlas` and `forms`."""

import json
import sys
from collections.abc import Callable
from pathlib import Path

import click

from lightbench.cli_options import axes_of, calls_of, folders
from lightbench.errors import LightbenchError

__all__ = ["atlas", "forms"]


@click.command()
@click.option(
    "-o", "--output", metavar="DIR", type=click.Path(path_type=Path),
    help="Folder for index.html and PNG sheets; default: atlas here, with --json alone none.",
)  # fmt: skip
@click.option(
    "--function", "functions", metavar="FILE:FUNCTION", multiple=True, callback=calls_of,
    help="What to map, as distributions/ggx.glsl:distribution; default: every choice.",
)  # fmt: skip
@click.option(
    "--axes", metavar="X,Y", default="", callback=axes_of, help="Inputs to sweep instead."
)
@click.option(
    "--size", type=click.IntRange(16, 1024), default=128, show_default=True, help="Points an axis."
)
@click.option(
    "--json", "as_json", metavar="FILE", type=click.Path(path_type=Path),
    help="Axes, figures and every point's error, for machines.",
)  # fmt: skip
@folders
def atlas(
    output: Path | None,
    functions: list[tuple[str, str]],
    axes: tuple[str, str],
    size: int,
    as_json: Path | None,
) -> None:
    """Map where shader functions lose their digits, in float32 and in half precision."""
    from lightbench import atlas as maps
    from lightbench import sweep
    from lightbench.image import write_whole
    from lightbench.library import read_library
    from lightbench.paths import shaders_folder

    library = read_library(shaders_folder())
    if axes[0] and not functions:
        raise LightbenchError("--axes is of one --function, which is not named")
    chosen = [sweep.sweep_of(library, *function, *axes) for function in functions]
    chosen = chosen or sweep.sweeps(library)
    if not chosen:
        raise LightbenchError(f"{shaders_folder()} has no function to map: no folder of choices")
    write = None if as_json and output is None else _atlas_writer()
    charts = [maps.chart(library, each, size) for each in chosen]
    if as_json:
        write_whole(as_json, json.dumps(maps.as_json(charts)).encode())
        click.echo(f"{as_json}: {len(charts)} maps")
    if write:
        folder = output or Path("atlas")
        click.echo(f"{folder}: {len(charts)} maps, in {', '.join(write(charts, folder))}")


def _atlas_writer() -> Callable[..., list[str]]:
    try:
        from lightbench.atlas_report import write
    except ModuleNotFoundError as error:
        if str(error.name).partition(".")[0] != "matplotlib":
            raise
        raise LightbenchError(
            f"pictures need matplotlib (--json alone does not); run: {sys.executable} -m pip "
            "install 'matplotlib>=3.10,<4'"
        ) from None
    return write


@click.command()
@click.option("--json", "as_json", is_flag=True, help="The same for machines.")
@click.option(
    "--runs", type=click.IntRange(1, 1000), default=15, show_default=True, help="Of each timing."
)
@folders
def forms(as_json: bool, runs: int) -> None:
    """Compare alternative forms of one formula: what each costs, and how far it is off."""
    from lightbench import forms as compared
    from lightbench.library import read_library
    from lightbench.paths import shaders_folder

    library = read_library(shaders_folder())
    groups = compared.groups(library)
    found = [form for group in groups for form in compared.compare(library, group, runs)]
    as_text = json.dumps(compared.as_json(found), indent=2, ensure_ascii=False)
    click.echo(as_text if as_json else compared.table(found))
