"""The shader folder read as a menu: front matter, code and contracts of every file.

`Library` is the manifest: what Python plans with, and, as JSON, what the browser plans with.
"""

import json
import re
import tomllib
from functools import cache
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ValidationError

from lightbench.contract import check_contract
from lightbench.errors import LightbenchError, ShaderError
from lightbench.expression import Value, evaluate
from lightbench.front_matter import MATERIAL_FIELDS, Choice, Folder, Pass, ShaderFile, Strict
from lightbench.shapes import ICOSPHERE_ERRORS

__all__ = ["Library", "read_library"]

GLSL_TYPES = {"float": "float", "color": "vec3"}
# What a pass may ask of the scene in its `when`: how many of these there are.
SCENE_NAMES = ("parts",)
Matter = TypeVar("Matter", bound=BaseModel)
_FRONT_MATTER = re.compile(r"\s*/\*---[ \t]*\n(.*?)---\*/", re.DOTALL)
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_TOML_LINE = re.compile(r"at line (\d+)")


class Library(Strict):
    """All of `shaders/`, validated. Keys of `files` are paths such as `models/phong.glsl`."""

    folders: dict[str, Folder]
    files: dict[str, ShaderFile]
    material_fields: dict[str, str] = MATERIAL_FIELDS
    icosphere_errors: tuple[float, ...] = ICOSPHERE_ERRORS

    def choices(self, folder: str) -> list[str]:
        """Names of a folder's files, sorted."""
        prefix = f"{folder}/"
        return sorted(p[len(prefix) : -len(".glsl")] for p in self.files if p.startswith(prefix))

    def stable(self, folder: str) -> list[str]:
        """Those of a folder's choices that are no textbook form, kept for comparison."""
        metas = {name: self.files[f"{folder}/{name}.glsl"].meta for name in self.choices(folder)}
        return [name for name, meta in metas.items() if not meta.textbook_of]

    def folder_of(self, setting: str) -> str:
        """The folder that a choice setting picks from."""
        return next(name for name, folder in self.folders.items() if folder.setting == setting)

    def promised(self, path: str) -> str | None:
        """The name of the function that a choice's folder promises; of another file, None."""
        folder = self.folders.get(path.rpartition("/")[0])
        if folder is None or not folder.function:
            return None
        return folder.function.split("(")[0].split()[-1]

    def per_light(self, resource: str) -> bool:
        """Whether there is one such texture for each light that casts shadows."""
        return any(m.each == "light" and resource in m.writes for m in self.passes().values())

    def passes(self) -> dict[str, Pass]:
        """Front matter of every pass by its name, sorted."""
        return {
            path.removeprefix("passes/").removesuffix(".glsl"): file.meta
            for path, file in sorted(self.files.items())
            if isinstance(file.meta, Pass)
        }


def read_library(root: Path) -> Library:
    """Read and validate a shader folder.

    Front matter is asked only of choices, the files of a folder with a `_choice.toml`, and of
    `passes/` beside them. A folder without any choice is a stranger's: its comments, which no
    compiler sees, need not be ASCII.

    Raises ShaderError naming file and line for front matter or code that breaks its contract.
    """
    root = root.resolve()
    if not root.is_dir():
        raise ShaderError(f"{root}: no such folder of shaders")
    stamp = tuple((str(p), p.stat().st_mtime_ns) for p in sorted(root.rglob("*.*")) if p.is_file())
    return _read_library(root, stamp)


@cache
def _read_library(root: Path, _stamp: tuple[tuple[str, int], ...]) -> Library:
    folders = {p.parent.name: _read_folder(root, p) for p in sorted(root.glob("*/_choice.toml"))}
    paths = sorted(root.rglob("*.glsl"))
    files = {p.relative_to(root).as_posix(): _read_file(root, p, folders) for p in paths}
    library = Library(folders=folders, files=files)
    _check_textbooks(library)
    _check_defaults(library)
    _check_parameters(library)
    return library


def _check_textbooks(library: Library) -> None:
    """A textbook form stands beside a form of the same folder that it shares a function with."""
    for path, file in library.files.items():
        if not file.meta.textbook_of:
            continue
        folder = path.rpartition("/")[0]
        beside = library.files.get(f"{folder}/{file.meta.textbook_of}.glsl")
        if beside is None or beside.meta.textbook_of:
            raise ShaderError(
                f"{path}:1: textbook_of '{file.meta.textbook_of}' is no file here that is none "
                f"itself; there is: {', '.join(library.stable(folder))}"
            )
        if not file.functions.keys() & beside.functions.keys():
            raise ShaderError(f"{path}:1: it defines no function of {file.meta.textbook_of}.glsl")


def _check_defaults(library: Library) -> None:
    for name, folder in library.folders.items():
        if folder.default not in library.stable(name):
            allowed = ", ".join(library.stable(name)) or "nothing: the folder is empty"
            raise ShaderError(
                f"{name}/_choice.toml:1: default '{folder.default}' is no file here; "
                f"there is: {allowed}"
            )


def _check_parameters(library: Library) -> None:
    """A parameter's name belongs to one folder (whose choices exclude each other) or one file."""
    owners: dict[str, str] = {f.setting: f"{n}/_choice.toml" for n, f in library.folders.items()}
    owners |= dict.fromkeys(SCENE_NAMES, "the scene")
    defaults: dict[str, Value] = {f.setting: f.default for f in library.folders.values()}
    defaults |= dict.fromkeys(SCENE_NAMES, 0.0)
    for path, file in library.files.items():
        folder = path.split("/")[0]
        for name, parameter in file.meta.parameters.items():
            owner = f"{folder}/" if folder in library.folders else path
            if owners.setdefault(name, owner) != owner:
                raise ShaderError(f"{path}:1: parameter '{name}' is already one of {owners[name]}")
            value = parameter.default
            defaults[name] = 0.0 if isinstance(value, tuple | str) else float(value)
    for name, meta in library.passes().items():
        targets = [text for t in meta.writes.values() for text in (t.scale, t.side)]
        for text in filter(None, (meta.when, *targets)):
            try:
                evaluate(text, defaults)
            except LightbenchError as error:
                raise ShaderError(f"passes/{name}.glsl:1: {error}") from None


def _read_folder(root: Path, path: Path) -> Folder:
    name = path.relative_to(root).as_posix()
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise ShaderError(f"{name}:1: is not UTF-8: {error.reason}") from None
    return _validated(Folder, _toml(name, text, 0), name, text, 0)


def _read_file(root: Path, path: Path, folders: dict[str, Folder]) -> ShaderFile:
    name = path.relative_to(root).as_posix()
    text = path.read_bytes().decode("latin-1")
    code = _COMMENT.sub(lambda m: "\n" * m[0].count("\n") or " ", text)
    for number, line in enumerate((text if folders else code).splitlines(), 1):
        if not line.isascii():
            raise ShaderError(f"{name}:{number}: shader files are ASCII; found {line.strip()!r}")
    folder = name.split("/")[0]
    render_pass = folder == "passes" and bool(folders)
    match = _FRONT_MATTER.match(text)
    if match is None and (folder in folders or render_pass):
        raise ShaderError(f"{name}:1: the file must begin with front matter, /*--- ... ---*/")
    block, offset = (match[1], text[: match.start(1)].count("\n")) if match else ("", 0)
    model = Pass if render_pass else Choice
    meta = _validated(model, _toml(name, block, offset), name, block, offset)
    if (folder in folders or render_pass) and not meta.title:
        raise ShaderError(f"{name}:{offset + 1}: the front matter needs a title")
    contract = folders.get(folder)
    functions = check_contract(
        name, code, contract.function if contract else "", contract.optional if contract else ()
    )
    return ShaderFile(meta=meta, code=code, functions=functions)


def _toml(name: str, block: str, offset: int) -> dict[str, object]:
    try:
        return tomllib.loads(block)
    except tomllib.TOMLDecodeError as error:
        line = _TOML_LINE.search(str(error))
        number = offset + int(line[1]) if line else offset + 1
        raise ShaderError(f"{name}:{number}: front matter: {error}") from None


def _validated(
    model: type[Matter], data: dict[str, object], name: str, block: str, offset: int
) -> Matter:
    try:
        # As JSON, where strictness still takes an array for a tuple.
        return model.model_validate_json(json.dumps(data, default=str))
    except ValidationError as error:
        first = error.errors()[0]
        keys = [str(key) for key in first["loc"]]
        number = offset + _line_of(block, keys)
        what = first["msg"].removeprefix("Value error, ")
        if first["type"] == "extra_forbidden":
            what = f"no such key; allowed are: {', '.join(model.model_fields)}"
        where = f"{'.'.join(keys)}: " if keys else ""
        raise ShaderError(f"{name}:{number}: front matter: {where}{what}") from None


def _line_of(block: str, keys: list[str]) -> int:
    """The line of the TOML block where the last of `keys` that it shows is set."""
    for key in reversed(keys):
        pattern = re.compile(rf"(^|[\s{{,.\[]){re.escape(key)}\s*[=\].]")
        for number, line in enumerate(block.splitlines(), 1):
            if pattern.search(line):
                return number
    return 1
