"""The service's pictures: what it accepts, one plan and one tag for each, thumbs kept."""

import json
import logging
import threading
from collections.abc import Mapping
from functools import cache
from typing import Any, Literal, NamedTuple

from fastapi import Response

from lightbench.answers import answer, caching, digest, matches, not_modified
from lightbench.errors import LightbenchError
from lightbench.image import FORMATS
from lightbench.library import read_library
from lightbench.options import THUMB, preset, version
from lightbench.paths import scenes_folder, shaders_folder
from lightbench.plan import plan
from lightbench.plan_types import Plan
from lightbench.render import on_gl_thread, renderer
from lightbench.scene import Scene
from lightbench.scene_file import scene_names
from lightbench.settings import Setting

__all__ = ["MAX_SIDE", "Format", "Gl", "Wanted", "gl", "picture", "thumb", "warm_up"]

MAX_SIDE = 4096
MAX_PIXELS = 16_000_000
# The largest target, supersampling included: 1920x1080 with 4x4 samples, half a gigabyte.
MAX_TARGET_PIXELS = 2**25
# Of a posted scene: every light is a block of shader code to compile, every object a draw.
MAX_LIGHTS = 64
MAX_OBJECTS = 4096
MAX_THUMBS = 256

Format = Literal["png", "npy", "exr"]


class Wanted(NamedTuple):
    """A picture as a request asks for it; `scene` is a preset's name or a scene's JSON data.

    A side that is not given is the scene's own.
    """

    scene: str | dict[str, Any]
    settings: Mapping[str, Setting]
    size: tuple[int | None, int | None]
    format: Format


class Gl(NamedTuple):
    """The GL's name and its largest side of a texture."""

    name: str
    limit: int


@cache
def gl() -> Gl:
    """Asked once, so that later nothing waits for the GL thread. Raises GraphicsError."""
    return on_gl_thread(lambda: Gl(renderer().name, renderer().limit))


def picture(wanted: Wanted, known: str | None) -> Response:
    """The picture, or 304 before anything is rendered if the client has it (If-None-Match)."""
    scene = _scene(wanted.scene)
    planned = _plan(scene, wanted.settings, scene.sized(*wanted.size))
    etag = _etag(planned, wanted.format)
    if matches(known, etag):
        return not_modified(etag)
    image = on_gl_thread(lambda: renderer().run(planned))
    encode, media = FORMATS[f".{wanted.format}"]
    body = image.png(level=1) if wanted.format == "png" else encode(image)
    headers = caching(etag) | {
        "X-Lightbench-Render-Ms": f"{image.milliseconds:.3f}",
        "X-Lightbench-Renderer": image.renderer.encode("ascii", "replace").decode(),
        "X-Lightbench-Invalid": str(image.invalid().total),
    }
    return Response(body, media_type=media, headers=headers)


_thumbs: dict[str, bytes] = {}


def thumb(name: str, known: str | None = None) -> Response:
    """The menu's picture of a preset, rendered once for each state of its plan."""
    planned = _plan(preset(name, scenes_folder()), {}, THUMB)
    etag = _etag(planned, "png")
    body = _thumbs.get(etag)
    if body is None:
        body = on_gl_thread(lambda: renderer().run(planned)).png()
        while len(_thumbs) >= MAX_THUMBS:
            _thumbs.pop(next(iter(_thumbs)), None)
        _thumbs[etag] = body
    return answer(body, "image/png", known)


def warm_up(stop: threading.Event) -> None:
    """Compile every preset's programs by rendering its thumb, until told to stop."""
    try:
        for name in scene_names(scenes_folder()):
            if stop.is_set():
                break
            thumb(name)
    except LightbenchError as error:
        logging.getLogger("uvicorn.error").warning("warm-up: %s", error)


def _scene(given: str | dict[str, Any]) -> Scene:
    if isinstance(given, str):
        return preset(given, scenes_folder())
    scene = Scene.parse(given)
    for kind, found, most in (
        ("lights", len(scene.lights), MAX_LIGHTS),
        ("objects", len(scene.objects), MAX_OBJECTS),
    ):
        if found > most:
            raise LightbenchError(f"scene: {kind}: {found}; this service allows {most}")
    return scene


def _plan(scene: Scene, settings: Mapping[str, Setting], size: tuple[int, int]) -> Plan:
    """The plan, once its targets are known to fit into memory and into this GL."""
    width, height = size
    if width * height > MAX_PIXELS:
        raise LightbenchError(
            f"size: {width}x{height} is {width * height / 1e6:.1f} megapixels; "
            f"at most {MAX_PIXELS / 1e6:g} are allowed"
        )
    planned = plan(read_library(shaders_folder()), scene, settings, size)
    limit = gl().limit
    for target in planned["targets"].values():
        w, h = target["size"]
        if w * h > MAX_TARGET_PIXELS or max(w, h) > limit:
            raise LightbenchError(
                f"size: {width}x{height} with these samples takes {w}x{h} values; sides to "
                f"{limit} and {MAX_TARGET_PIXELS / 1e6:.0f} million values are allowed"
            )
    return planned


def _etag(planned: Plan, form: str) -> str:
    """A strong tag: the plan holds the scene's numbers, the settings and the shader sources."""
    return f'"{digest(json.dumps([planned, gl().name, form, version()]).encode())}"'
