"""The REST service: pictures, scenes and settings over HTTP, and the playground at `/`.

A request is planned and encoded on a few worker threads; OpenGL runs on the one thread that owns
it. What waits is bounded, so a busy service says so at once.
"""

import threading
from collections import Counter
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from typing import Annotated, Any

import anyio.to_thread
from fastapi import APIRouter, Depends, FastAPI, Header, Query, Request, Response
from fastapi.responses import HTMLResponse
from fastapi.staticfiles import StaticFiles
from pydantic import BaseModel, ConfigDict, Field
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware

from lightbench import assets, atlas_data
from lightbench.answers import BusyError, Problem, answer, json_answer, refuse_all
from lightbench.errors import LightbenchError, ModelError
from lightbench.gltf import Limits
from lightbench.image import FORMATS
from lightbench.library import read_library
from lightbench.options import manifest, options, preset, scenes, version
from lightbench.paths import scenes_folder, shaders_folder, web_folder
from lightbench.pictures import MAX_SIDE, Format, Wanted, gl, picture, thumb, warm_up
from lightbench.scene_file import model_scene
from lightbench.shapes import mesh, pack
from lightbench.tables import packed_hierarchy

__all__ = ["create_app"]

MAX_WAITING = 64
WORKERS = 4


class RenderRequest(BaseModel):
    """A picture to render."""

    model_config = ConfigDict(extra="forbid")

    scene: Annotated[
        str | dict[str, Any],
        Field(description="a preset's name, or a scene as in `/api/scenes/{name}`"),
    ]
    settings: Annotated[
        dict[str, bool | int | float | str | list[float] | None],
        Field(description="{NAME: VALUE}, see `/api/options`", examples=[{"model": "phong"}]),
    ] = {}
    width: Annotated[int | None, Field(ge=1, le=MAX_SIDE)] = None
    height: Annotated[int | None, Field(ge=1, le=MAX_SIDE)] = None
    format: Format = "png"


PROBLEMS: dict[int | str, dict[str, Any]] = {
    404: {"model": Problem, "description": "No scene, mesh or page of that name"},
    422: {"model": Problem, "description": "Something to change; the message says what is allowed"},
    503: {"model": Problem, "description": "No OpenGL here, or too many requests (Retry-After)"},
}
PICTURE: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The picture: PNG is 8-bit display code; NPY and EXR are linear float32",
        "content": {media: {} for _, media in FORMATS.values()},
        "headers": {
            "ETag": {"description": "changes with scene, settings, shader sources and renderer"},
            "X-Lightbench-Render-Ms": {"description": "time of the passes, to their completion"},
            "X-Lightbench-Renderer": {"description": "the GL that ran them"},
            "X-Lightbench-Invalid": {"description": "pixels that are NaN, infinite or negative"},
        },
    },
    304: {"description": "If-None-Match names this very picture; nothing was rendered"},
}
# How `/docs` offers settings: as further query parameters of any name.
SETTINGS_PARAMETER = {
    "name": "settings",
    "in": "query",
    "description": "Any setting of `/api/options` as NAME=VALUE, such as model=phong&exposure=1",
    "style": "form",
    "explode": True,
    "schema": {"type": "object", "additionalProperties": {"type": "string"}},
    "example": {"model": "cook_torrance"},
}
Known = Annotated[str | None, Header(alias="If-None-Match", include_in_schema=False)]

api = APIRouter(prefix="/api", responses=PROBLEMS)
data = APIRouter(prefix="/data", include_in_schema=False)
health = APIRouter(responses={503: PROBLEMS[503]})


def create_app(limits: Limits | None = None) -> FastAPI:
    """The service, reading shaders and scenes from where `paths` says at each request.

    `limits` bound the models that it takes.
    """
    app = FastAPI(
        title="Lightbench",
        version=version(),
        description="Pictures of lit scenes, from the same GLSL that the playground runs.",
        lifespan=_lifespan,
    )
    app.state.workers = anyio.CapacityLimiter(WORKERS)
    app.state.pending = 0
    app.state.limits = limits or Limits()
    excluded = (*DEFAULT_EXCLUDED_CONTENT_TYPES, *(media for _, media in FORMATS.values()))
    app.add_middleware(GZipMiddleware, compresslevel=5, exclude_content_types=excluded)
    refuse_all(app)
    for router in (api, data, health):
        app.include_router(router)
    if (web_folder() / "index.html").is_file():
        app.mount("/", Playground(directory=web_folder(), html=True))
    else:
        app.add_api_route("/", _not_built, include_in_schema=False)
    return app


@asynccontextmanager
async def _lifespan(_app: FastAPI) -> AsyncIterator[None]:
    """Compile the presets' programs while the first requests already come in."""
    stop = threading.Event()
    warmer = threading.Thread(target=warm_up, args=(stop,), name="warm", daemon=True)
    warmer.start()
    yield
    stop.set()
    await anyio.to_thread.run_sync(warmer.join)


@api.get("/scenes", summary="The presets")
def get_scenes(request: Request) -> Response:
    """Title and description of every preset, by its name."""
    return json_answer(request, scenes(scenes_folder()))


@api.get("/scenes/{name:path}", summary="One preset")
def get_scene(request: Request, name: str) -> Response:
    """A preset as JSON, every default filled in; edit it and post it to `/api/render`."""
    return json_answer(request, preset(name, scenes_folder()).data())


@api.get("/options", summary="The settings")
def get_options(request: Request) -> Response:
    """Every setting with what it allows: choices, their parameters, the scene's own fields."""
    return json_answer(request, options(read_library(shaders_folder())))


SIDE = "pixels; where not given, the scene's own, or 640 x 480"


def _size(
    width: Annotated[int | None, Query(ge=1, le=MAX_SIDE, description=SIDE)] = None,
    height: Annotated[int | None, Query(ge=1, le=MAX_SIDE, description=SIDE)] = None,
) -> tuple[int | None, int | None]:
    return width, height


@api.get(
    "/render/{name:path}.{format}",
    summary="A picture of a preset",
    response_class=Response,
    responses=PICTURE,
    openapi_extra={"parameters": [SETTINGS_PARAMETER]},
)
async def get_render(
    request: Request,
    name: str,
    format: Format,  # noqa: A002 -- the name in the route
    size: Annotated[tuple[int | None, int | None], Depends(_size)],
    known: Known = None,
) -> Response:
    """The preset `name` under the settings of the query; a setting left out keeps its default."""
    wanted = Wanted(name, _settings(request), size, format)
    return await _queued(request, lambda: picture(wanted, known))


@api.post(
    "/render",
    summary="A picture of any scene",
    response_class=Response,
    responses=PICTURE,
)
async def post_render(request: Request, body: RenderRequest, known: Known = None) -> Response:
    """A preset, or a scene of your own, under the given settings."""
    wanted = Wanted(body.scene, body.settings, (body.width, body.height), body.format)
    return await _queued(request, lambda: picture(wanted, known))


@api.post(
    "/models",
    summary="A model of your own",
    responses={200: {"description": "The scene of the model, to edit and to post to /api/render"}},
    openapi_extra={
        "requestBody": {
            "required": True,
            "content": {"model/gltf-binary": {"schema": {"type": "string", "format": "binary"}}},
        }
    },
)
async def post_model(
    request: Request,
    name: Annotated[str, Query(max_length=200, description="for messages and the title")] = "model",
) -> Response:
    """A glTF file (.glb, or a .gltf that refers to nothing beside it) as a scene.

    Its meshes and images are kept until newer uploads need the room.
    """
    limits: Limits = request.app.state.limits
    content = await _body(request, limits.file_bytes, name)
    return await _queued(
        request, lambda: json_answer(request, model_scene(content, limits, name).data())
    )


async def _body(request: Request, most: int, name: str) -> bytes:
    """The request's body, refused as soon as it is too large."""
    content = bytearray()
    async for chunk in request.stream():
        content += chunk
        if len(content) > most:
            raise ModelError(f"{name}: is larger than the {most} bytes that are allowed")
    return bytes(content)


@health.get("/healthz", summary="Health")
def healthz() -> dict[str, str]:
    """Whether the service can render, and with what."""
    return {"status": "ok", "renderer": gl().name, "version": version()}


@data.get("/manifest.json")
def get_manifest(request: Request) -> Response:
    return json_answer(request, manifest(read_library(shaders_folder()), scenes_folder()))


@data.get("/scenes/{name:path}.json")
def get_scene_file(request: Request, name: str) -> Response:
    return get_scene(request, name)


@data.get("/meshes/{key}.bin")
def get_mesh(key: str, known: Known = None) -> Response:
    return answer(pack(mesh(key)), "application/octet-stream", known)


@data.get("/hierarchies/{key}.bin")
async def get_hierarchy(request: Request, key: str, known: Known = None) -> Response:
    """What rays read of a mesh: baking a large one takes a second."""
    media = "application/octet-stream"
    return await _queued(request, lambda: answer(packed_hierarchy(key), media, known))


@data.get("/textures/{key}.png")
def get_texture(key: str, known: Known = None) -> Response:
    return answer(assets.image(key), "image/png", known)


@data.get("/atlas.json")
def get_atlas(request: Request) -> Response:
    return json_answer(request, atlas_data.index(read_library(shaders_folder())))


@data.get("/atlas/{file:path}/{function}/{x}/{y}.bin")
async def get_atlas_map(
    request: Request, file: str, function: str, x: str, y: str, known: Known = None
) -> Response:
    def work() -> Response:
        library = read_library(shaders_folder())
        found = atlas_data.document(library, f"{file}.glsl", function, x, y)
        return answer(found, "application/octet-stream", known)

    return await _queued(request, work)


@data.get("/thumbs/{name:path}.png")
async def get_thumb(request: Request, name: str, known: Known = None) -> Response:
    return await _queued(request, lambda: thumb(name, known))


class Playground(StaticFiles):
    """The built page; a browser asks each time whether a file is still the same."""

    def file_response(self, *args: Any, **kwargs: Any) -> Response:
        response = super().file_response(*args, **kwargs)
        response.headers["Cache-Control"] = "no-cache"
        return response


def _not_built() -> HTMLResponse:
    return HTMLResponse(
        "<!doctype html><title>Lightbench</title><p>The playground is not built. Run "
        "<code>make play</code> in the checkout.<p>The REST service runs: <a href=/docs>/docs</a>.",
        status_code=503,
    )


async def _queued(request: Request, work: Callable[[], Response]) -> Response:
    """Run `work` on a worker thread; at most MAX_WAITING wait for one."""
    state = request.app.state
    if state.pending >= WORKERS + MAX_WAITING:
        raise BusyError(f"{MAX_WAITING} requests wait already; ask again in a second")
    state.pending += 1
    try:
        return await anyio.to_thread.run_sync(work, limiter=state.workers)
    finally:
        state.pending -= 1


def _settings(request: Request) -> dict[str, str]:
    """The query without the size."""
    given = request.query_params.multi_items()
    repeated = [name for name, count in Counter(name for name, _ in given).items() if count > 1]
    if repeated:
        raise LightbenchError(f"{repeated[0]}: is given more than once; give one value")
    return {name: value for name, value in given if name not in ("width", "height")}
