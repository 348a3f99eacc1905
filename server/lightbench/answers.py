"""What the service answers: bodies with a tag to compare, and one table from errors to status."""

import hashlib
import json
from collections.abc import Mapping

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import BaseModel
from starlette.exceptions import HTTPException

from lightbench.errors import GraphicsError, LightbenchError, NotFoundError

__all__ = [
    "STATUS",
    "BusyError",
    "Problem",
    "answer",
    "caching",
    "digest",
    "json_answer",
    "matches",
    "not_modified",
    "refuse_all",
]


class BusyError(LightbenchError):
    """More requests wait than the service accepts."""


# The nearest class of an error decides. ShaderError is 422 as the rest: the request chose a file
# that cannot be used, and the message says which line to change or that another choice works.
STATUS: dict[type[Exception], int] = {
    NotFoundError: 404,
    LightbenchError: 422,
    GraphicsError: 503,
    BusyError: 503,
}


class Detail(BaseModel):
    """What is wrong and what is allowed."""

    type: str
    message: str


class Problem(BaseModel):
    """The body of every error."""

    error: Detail


def digest(content: bytes) -> str:
    """A short strong hash."""
    return hashlib.sha256(content).hexdigest()[:32]


def matches(known: str | None, etag: str) -> bool:
    """Whether the If-None-Match header `known` names this tag."""
    tags = [tag.strip().removeprefix("W/") for tag in (known or "").split(",")]
    return "*" in tags or etag.removeprefix("W/") in tags


def not_modified(etag: str) -> Response:
    """304 for a body that the client has."""
    return Response(status_code=304, headers=caching(etag))


def answer(body: bytes, media: str, known: str | None, weak: str = "") -> Response:
    """The body under a tag of its content, or 304."""
    etag = f'{weak}"{digest(body)}"'
    if matches(known, etag):
        return not_modified(etag)
    return Response(body, media_type=media, headers=caching(etag))


def json_answer(request: Request, content: object) -> Response:
    """JSON with a weak tag, since it may be compressed on its way."""
    body = json.dumps(content, ensure_ascii=False, separators=(",", ":")).encode()
    return answer(body, "application/json", request.headers.get("if-none-match"), "W/")


def caching(etag: str) -> dict[str, str]:
    """Headers of a body to keep, and to ask about each time."""
    return {"ETag": etag, "Cache-Control": "no-cache"}


def refuse_all(app: FastAPI) -> None:
    """Give every error of the app the one JSON shape."""
    app.add_exception_handler(LightbenchError, _refuse)
    app.add_exception_handler(RequestValidationError, _refuse_request)
    app.add_exception_handler(HTTPException, _refuse_route)
    app.add_exception_handler(Exception, _fail)


def _problem(status: int, kind: str, message: str, headers: Mapping[str, str] | None) -> Response:
    # A lone surrogate, which JSON can carry in, has no UTF-8.
    sound = message.encode("utf-8", "replace").decode()
    content = Problem(error=Detail(type=kind, message=sound)).model_dump()
    return JSONResponse(content, status, dict(headers or {}))


def _refuse(_request: Request, error: Exception) -> Response:
    status = next(STATUS[kind] for kind in type(error).__mro__ if kind in STATUS)
    retry = {"Retry-After": "1"} if isinstance(error, BusyError) else None
    return _problem(status, type(error).__name__, str(error), retry)


def _refuse_request(_request: Request, error: Exception) -> Response:
    assert isinstance(error, RequestValidationError)
    first = error.errors()[0]
    if first["type"] == "json_invalid":
        return _problem(422, "RequestError", "body: is not JSON", None)
    path = [str(key) for key in first["loc"] if key not in ("query", "path", "body")]
    given = first.get("input")
    shown = "" if isinstance(given, dict | list | None) else f" (given {given!r})"
    where = f"{'.'.join(path)}: " if path else ""
    return _problem(422, "RequestError", f"{where}{first['msg']}{shown}", None)


def _refuse_route(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    message = f"{request.method} {request.url.path}: {error.detail}; the routes are at /docs"
    return _problem(error.status_code, "HTTPException", message, error.headers)


def _fail(_request: Request, _error: Exception) -> Response:
    """A flaw in the service itself; the server logs its traceback."""
    return _problem(500, "InternalError", "the service failed; its log says where", None)
