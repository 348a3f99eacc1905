"""Options that more than one command has, and what reads the values of options."""

import os
import re
from collections.abc import Callable
from typing import Any, TypeVar

import click

__all__ = ["assignments_of", "axes_of", "calls_of", "folders", "limits_of", "size_of"]

Command = TypeVar("Command", bound=Callable[..., Any])


def size_of(
    _context: click.Context, _option: click.Parameter, value: str | None
) -> tuple[int, int] | None:
    """WIDTHxHEIGHT, where it is given."""
    if value is None:
        return None
    match = re.fullmatch(r"(\d{1,6})x(\d{1,6})", value, re.ASCII)
    if match is None:
        raise click.BadParameter(f"{value!r} is not WIDTHxHEIGHT in pixels, such as 640x480")
    return int(match[1]), int(match[2])


def assignments_of(
    _context: click.Context, _option: click.Parameter, values: tuple[str, ...]
) -> dict[str, str]:
    """NAME=VALUE, any number of times."""
    settings = {}
    for value in values:
        name, equals, text = value.partition("=")
        if not name or not equals:
            raise click.BadParameter(f"{value!r} is not NAME=VALUE, such as model=phong")
        settings[name] = text
    return settings


def limits_of(
    _context: click.Context, _option: click.Parameter, values: tuple[str, ...]
) -> dict[str, int]:
    """NAME=NUMBER of a model's limits, any number of times."""
    from lightbench.gltf import Limits

    found = {}
    for value in values:
        name, _, number = value.partition("=")
        if name not in Limits.model_fields or not re.fullmatch(r"[1-9]\d{0,9}", number, re.ASCII):
            known = ", ".join(Limits.model_fields)
            raise click.BadParameter(f"{value!r} is not NAME=NUMBER of one of: {known}")
        found[name] = int(number)
    return found


def calls_of(
    _context: click.Context, _option: click.Parameter, values: tuple[str, ...]
) -> list[tuple[str, str]]:
    """FILE:FUNCTION, any number of times."""
    parts = [value.rpartition(":") for value in values]
    for file, _, function in parts:
        if not file or not function:
            raise click.BadParameter(
                f"{':'.join(filter(None, (file, function)))!r} is not FILE:FUNCTION, such as "
                "distributions/ggx.glsl:distribution"
            )
    return [(file, function) for file, _, function in parts]


def axes_of(_context: click.Context, _option: click.Parameter, value: str) -> tuple[str, str]:
    """X,Y, or nothing."""
    x, comma, y = value.partition(",")
    if value and not (x and comma and y):
        raise click.BadParameter(f"{value!r} is not X,Y, two inputs such as alpha,NoV")
    return x, y


def _use_folder(_context: click.Context, option: click.Parameter, value: str | None) -> None:
    if value is not None:
        os.environ[f"LIGHTBENCH_{str(option.name).upper()}"] = value


def folders(command: Command) -> Command:
    """Add --shaders and --scenes, which stand above the environment variables of that name."""
    for name in ("scenes", "shaders"):
        command = click.option(
            f"--{name}",
            type=click.Path(exists=True, file_okay=False),
            envvar=f"LIGHTBENCH_{name.upper()}",
            expose_value=False,
            callback=_use_folder,
            help=f"Folder of {name} to read instead of the built-in one.",
        )(command)
    return command
