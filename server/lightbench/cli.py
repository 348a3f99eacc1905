"""The `lightbench` command. What a person got wrong is one line on standard error and exit 2."""

import json
import socket
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

import click

from lightbench.cli_figures import figures
from lightbench.cli_gamma import gamma
from lightbench.cli_options import assignments_of, folders, limits_of, size_of
from lightbench.cli_stability import atlas, forms
from lightbench.errors import LightbenchError

__all__ = ["main"]

INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and exit: 0, 1 for `doctor` with something missing, 2 for a mistake."""
    try:
        code = cli.main(arguments, prog_name="lightbench", standalone_mode=False)
    except click.Abort:
        sys.exit(INTERRUPTED)
    except click.ClickException as error:
        _refuse(error.format_message())
    except LightbenchError as error:
        _refuse(str(error))
    except OSError as error:
        _refuse(f"{error.filename}: {error.strerror}" if error.filename else str(error))
    sys.exit(code if isinstance(code, int) else 0)


def _refuse(message: str) -> NoReturn:
    """One line: what was wrong; the lines of a shader error stand beside each other."""
    click.echo(
        "lightbench: " + " | ".join(filter(None, map(str.strip, message.splitlines()))), err=True
    )
    sys.exit(2)


@click.group(invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="lightbench", message="%(prog)s %(version)s")
@folders
@click.pass_context
def cli(context: click.Context) -> None:
    """A bench for light: pick a scene and how it is lit; see the picture and its cost."""
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


@cli.command()
@click.argument("scene")
@click.option("-o", "--output", metavar="FILE", help=".png, .npy or .exr; default: NAME.png here.")
@click.option(
    "--size",
    metavar="WxH",
    callback=size_of,
    help="In pixels; default: the scene's own, or 640x480.",
)
@click.option(
    "--set", "settings", metavar="NAME=VALUE", multiple=True, callback=assignments_of,
    help="Of `lightbench options`, or the scene's own, as camera.fov=60; the last one counts.",
)  # fmt: skip
@click.option("--view", metavar="VIEW", help="What to show of the picture, as --set view=VIEW.")
@click.option(
    "--attachment", metavar="NAME",
    help="Save what a pass writes, as it is: radiance, normal_distance, shadow_map.0, ...",
)  # fmt: skip
@click.option(
    "--limit", "limits", metavar="NAME=NUMBER", multiple=True, callback=limits_of,
    help="Largest model that is read, as triangles=1000000; again for others.",
)  # fmt: skip
@folders
def render(
    scene: str,
    output: str | None,
    size: tuple[int, int] | None,
    settings: dict[str, str],
    view: str | None,
    attachment: str | None,
    limits: dict[str, int],
) -> None:
    """Render SCENE, a preset's name or the path of a scene .json, .glb or .gltf, to a file."""
    from lightbench import load, render_plan
    from lightbench.gltf import Limits

    path = Path(output if output is not None else f"{Path(scene).stem}.png")
    loaded = load(scene, Limits(**limits))
    _check_ending(path)
    given = settings | ({} if view is None else {"view": view})
    image = render_plan(loaded, size or loaded.sized(), given, attachment or "linear")
    if attachment is not None:
        image = image.as_stored()
    image.save(path)
    height, width = image.linear.shape[:2]
    click.echo(f"{path}  {width}x{height}  {image.milliseconds:.1f} ms  {image.renderer}")
    invalid = image.invalid()
    if invalid.total:
        click.secho(
            f"WARNING: {path} is not valid light: {invalid.nan} NaN, {invalid.inf} infinite and "
            f"{invalid.negative} negative pixels (--view invalid shows where)",
            fg="red", bold=True, err=True,
        )  # fmt: skip


def _check_ending(path: Path) -> None:
    from lightbench.image import FORMATS

    if path.suffix not in FORMATS:
        raise LightbenchError(
            f"{path}: no format '{path.suffix}'; allowed are: {', '.join(FORMATS)}"
        )


@cli.command()
@click.option("--host", default="127.0.0.1", show_default=True, help="Address to listen on.")
@click.option("--port", type=click.IntRange(0, 65535), default=8000, show_default=True)
@click.option(
    "--limit", "limits", metavar="NAME=NUMBER", multiple=True, callback=limits_of,
    help="Largest model that is taken, as file_bytes=10000000; again for others.",
)  # fmt: skip
@folders
def serve(host: str, port: int, limits: dict[str, int]) -> None:
    """Serve the playground and the REST service."""
    import uvicorn

    from lightbench.api import create_app
    from lightbench.gltf import Limits
    from lightbench.library import read_library
    from lightbench.paths import shaders_folder

    read_library(shaders_folder())
    app = create_app(Limits(**limits))
    with _listen(host, port) as listener:
        shown = f"[{host}]" if ":" in host else host
        click.echo(f"Lightbench at http://{shown}:{listener.getsockname()[1]} (REST at /docs)")
        server = uvicorn.Server(uvicorn.Config(app, log_level="warning", access_log=False))
        try:
            server.run(sockets=[listener])
        except KeyboardInterrupt:
            click.echo()


def _listen(host: str, port: int) -> socket.socket:
    try:
        family, *_, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        return socket.create_server(address[:2], family=family, backlog=2048)
    except (OSError, UnicodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise LightbenchError(f"cannot listen on {host}:{port}: {reason}") from None


@cli.command()
@click.option("--json", "as_json", is_flag=True, help="As GET /api/scenes answers.")
@folders
def scenes(as_json: bool) -> None:
    """List the presets."""
    from lightbench.options import scenes as presets
    from lightbench.paths import scenes_folder

    found = presets(scenes_folder())
    if as_json:
        click.echo(json.dumps(found, indent=2, ensure_ascii=False))
        return
    for name, scene in found.items():
        click.echo(f"{name:<24} {scene['title']}")


@cli.command()
@click.option("--json", "as_json", is_flag=True, help="As GET /api/options answers.")
@folders
def options(as_json: bool) -> None:
    """List every setting, with what it allows."""
    from lightbench import options as menu
    from lightbench.library import read_library
    from lightbench.paths import shaders_folder

    library = read_library(shaders_folder())
    as_text = json.dumps(menu.options(library), indent=2, ensure_ascii=False)
    click.echo(as_text if as_json else menu.listing(library))


@cli.command()
@folders
def doctor() -> int:
    """Say which OpenGL was found, what is missing and the command that installs it."""
    from lightbench.doctor import checks

    missing = False
    for check in checks():
        click.echo(check)
        missing = missing or (check.needed and not check.ok)
    return int(missing)


@cli.command()
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
@folders
def bake(folder: Path) -> None:
    """Write the playground as static files to DIR, which is replaced if an earlier bake made it."""
    from lightbench.bake import bake as bake_to

    click.echo(f"{folder}: {bake_to(folder)} files; serve them with any web server")


cli.add_command(atlas)
cli.add_command(forms)
cli.add_command(figures)
cli.add_command(gamma)

if __name__ == "__main__":
    main()
