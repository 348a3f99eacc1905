"""From an entry file and its settings to the one GLSL source that both runtimes compile.

Resolves `#include`, `#if` and `#for`, so that what is left is live code only, then declares exactly
the defines, parameters and samplers that this code names.
"""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from lightbench.errors import LightbenchError, ShaderError
from lightbench.expression import evaluate
from lightbench.library import GLSL_TYPES, Library
from lightbench.prune import live
from lightbench.surface import NO_PATTERN, Pattern, pattern_lists

__all__ = ["UNIFORM", "Request", "Source", "assemble"]

Record = Mapping[str, str]
Line = tuple[int, str]

_DIRECTIVE = re.compile(r"\s*#\s*(\w*)\s*(.*?)\s*$")
_INCLUDE = re.compile(r'(?:"([^"]+)"|<(\w+)>)$')
# Fields that only the base under the facets has.
BASE_FIELDS = ("base_color", "kd")

_NAME = re.compile(r"[A-Za-z_]\w*")
UNIFORM = re.compile(r"^\s*uniform\s+(?:(?:high|medium|low)p\s+)?(\w+)\s+(u_\w+)\s*;", re.MULTILINE)
_ATTRIBUTE = re.compile(r"^\s*in\s+(\w+)\s+(a_\w+)\s*;", re.MULTILINE)
_TAKEN = re.compile(r"^\s*in\s+\w+\s+(v_\w+)\s*;", re.MULTILINE)


@dataclass(frozen=True)
class Request:
    """What to assemble: one stage of one file, under fully resolved settings.

    `values` holds the int and bool parameters and other defines, `lists` the records that `#for`
    repeats over, `pattern` how a surface varies. `varyings` are those that the fragment stage takes
    in: the vertex stage's others go.
    """

    entry: str
    stage: str
    choices: Mapping[str, str]
    values: Mapping[str, float]
    lists: Mapping[str, tuple[Record, ...]] = field(default_factory=dict)
    pattern: Pattern = NO_PATTERN
    varyings: tuple[str, ...] = ()


@dataclass(frozen=True)
class Source:
    """One specialised source. `lines[i]` says where the text's line i comes from, `file:line`."""

    text: str
    lines: tuple[str, ...]
    files: tuple[str, ...]
    settings: tuple[str, ...]
    uniforms: Mapping[str, str]
    attributes: Mapping[str, str]
    varyings: tuple[str, ...]


def assemble(library: Library, request: Request) -> Source:
    """The specialised source of one stage.

    Raises ShaderError naming file and line for a missing or cyclic include, an undefined name in
    `#if` or an unbalanced directive.
    """
    first = _Expansion(library, request, *_field_lists(library, request, ()))
    expansion = _Expansion(library, request, *_field_lists(library, request, first.files))
    output = live(expansion.output, request.stage, request.varyings)
    body = "\n".join(text for text, _, _ in output)
    head = _prologue(library, expansion, set(_NAME.findall(body)))
    text = "\n".join([*head, body, ""])
    return Source(
        text=text,
        lines=(
            *(f"prologue:{number}" for number in range(1, len(head) + 1)),
            *(f"{file}:{line}" for _, file, line in output),
        ),
        files=tuple(expansion.files),
        settings=tuple(expansion.settings),
        uniforms={name: kind for kind, name in UNIFORM.findall(text)},
        attributes={name: kind for kind, name in _ATTRIBUTE.findall(text)},
        varyings=tuple(sorted(_TAKEN.findall(text))),
    )


def _field_lists(
    library: Library, request: Request, files: Iterable[str]
) -> tuple[dict[str, tuple[Record, ...]], dict[str, float]]:
    """The lists and defines that follow from what the files say that they read."""
    metas = [library.files[path].meta for path in files]
    read = {name for meta in metas for name in meta.material}
    light = {name for m in metas for name, p in m.parameters.items() if p.per == "light"}
    material = library.material_fields.items()
    parts = {part for meta in metas for part in meta.surface}
    lists, defines = pattern_lists(request.pattern, read, parts)
    lists |= {
        "MATERIAL_FIELDS": tuple(
            {"type": t, "name": n, "base": str(int(n in BASE_FIELDS))}
            for n, t in material
            if n in read
        ),
        "LIGHT_FIELDS": tuple({"type": "float", "name": n} for n in sorted(light)),
    }
    return lists, defines


def _prologue(library: Library, expansion: "_Expansion", used: set[str]) -> list[str]:
    """Version, precision, and the declarations that the code asks for, in a fixed order."""
    uniforms: dict[str, str] = {}
    samplers: set[str] = set()
    casters = [record["index"] for record in expansion.lists.get("CASTERS", ())]
    for path in expansion.files:
        meta = library.files[path].meta
        for name in meta.reads:
            several = library.per_light(name)
            samplers.update(f"u_{name}{i}" for i in (casters if several else ("",)))
        for name, parameter in meta.parameters.items():
            if parameter.kind in GLSL_TYPES and parameter.per == "frame":
                uniforms[f"u_{name}"] = GLSL_TYPES[parameter.kind]
    defines = sorted(used & set(expansion.defines))
    return [
        "#version 300 es",
        "precision highp float;",
        "precision highp int;",
        *(f"#define {name} {expansion.defines[name]:.0f}" for name in defines),
        *(f"uniform {uniforms[name]} {name};" for name in sorted(uniforms) if name in used),
        *(f"uniform highp sampler2D {name};" for name in sorted(samplers & used)),
    ]


class _Expansion:
    """One run over the entry file and all it includes."""

    def __init__(
        self,
        library: Library,
        request: Request,
        fields: Mapping[str, tuple[Record, ...]],
        defines: Mapping[str, float],
    ) -> None:
        self.library, self.choices = library, request.choices
        self.lists = {**request.lists, **fields}
        self.defines = {**_defines(library, request, self.lists), **defines}
        self.files: list[str] = []
        self.settings: list[str] = []
        self.output: list[tuple[str, str, int]] = []
        self.include(request.entry, (), (request.entry, 0))

    def include(self, path: str, chain: tuple[str, ...], where: tuple[str, int]) -> None:
        if path in chain:
            cycle = " -> ".join([*chain[chain.index(path) :], path])
            raise ShaderError(f"{where[0]}:{where[1]}: include cycle: {cycle}")
        if path in self.files:
            return
        if path not in self.library.files:
            raise ShaderError(f"{where[0]}:{where[1]}: no such file to include: {path}")
        self.files.append(path)
        lines = list(enumerate(self.library.files[path].code.split("\n"), 1))
        self.run(lines, (*chain, path), loop=False)

    def run(self, lines: list[Line], chain: tuple[str, ...], *, loop: bool) -> None:
        """Process lines of the file `chain[-1]`; inside `#for`, `loop` forbids includes."""
        at = 0
        while at < len(lines):
            number, text = lines[at]
            match = _DIRECTIVE.match(text)
            if match is None:
                self.emit(text, chain[-1], number)
            elif match[1] in ("if", "for"):
                end = self.block_end(lines, at, match[1], chain[-1])
                if match[1] == "if":
                    self.run(self.branch(lines[at : end + 1], chain[-1]), chain, loop=loop)
                else:
                    self.repeat(match[2], lines[at : end + 1], chain)
                at = end
            elif match[1] == "include":
                self.follow(match[2], chain, number, loop=loop)
            elif match[1] == "define":
                self.emit(text, chain[-1], number)
            else:
                raise self.error(chain[-1], number, f"#{match[1]} has no place here")
            at += 1

    def emit(self, text: str, file: str, number: int) -> None:
        if "@{" in text:
            raise self.error(
                file, number, f"no list around this line has the key of {text.strip()}"
            )
        if text.strip():
            self.output.append((text.rstrip(), file, number))

    def follow(self, target: str, chain: tuple[str, ...], number: int, *, loop: bool) -> None:
        match = _INCLUDE.match(target)
        if match is None or loop:
            allowed = '#include "lib/file.glsl" or #include <setting>, outside of #for'
            raise self.error(chain[-1], number, f"write {allowed}")
        path = match[1]
        if path is None:
            setting = match[2]
            if setting not in self.choices:
                known = ", ".join(sorted(self.choices))
                raise self.error(chain[-1], number, f"no setting <{setting}>; there is: {known}")
            if setting not in self.settings:
                self.settings.append(setting)
            path = f"{self.library.folder_of(setting)}/{self.choices[setting]}.glsl"
        self.include(path, chain, (chain[-1], number))

    def block_end(self, lines: list[Line], start: int, opener: str, file: str) -> int:
        depth = 0
        for at in range(start, len(lines)):
            match = _DIRECTIVE.match(lines[at][1])
            if match is not None:
                depth += (match[1] == opener) - (match[1] == f"end{opener}")
                if depth == 0:
                    return at
        raise self.error(file, lines[start][0], f"#{opener} without #end{opener}")

    def branch(self, block: list[Line], file: str) -> list[Line]:
        """The lines of the first branch of `#if … #endif` whose condition holds."""
        depth, begin, live = 0, 0, self.holds(block[0], file)
        for at, (_, text) in enumerate(block):
            match = _DIRECTIVE.match(text)
            word = match[1] if match else ""
            if depth == 1 and word in ("elif", "else", "endif"):
                if live:
                    return block[begin + 1 : at]
                begin, live = at, word == "else" or (word == "elif" and self.holds(block[at], file))
            depth += (word == "if") - (word == "endif")
        return []

    def holds(self, line: Line, file: str) -> bool:
        match = _DIRECTIVE.match(line[1])
        try:
            return bool(evaluate(match[2] if match else "", self.defines))
        except LightbenchError as error:
            raise self.error(file, line[0], str(error)) from None

    def repeat(self, name: str, block: list[Line], chain: tuple[str, ...]) -> None:
        if name not in self.lists:
            known = ", ".join(sorted(self.lists))
            raise self.error(chain[-1], block[0][0], f"no list {name}; there is: {known}")
        for record in self.lists[name]:
            body = [(number, _bind(text, record)) for number, text in block[1:-1]]
            self.run(body, chain, loop=True)

    def error(self, file: str, number: int, what: str) -> ShaderError:
        return ShaderError(f"{file}:{number}: {what}")


def _bind(text: str, record: Record) -> str:
    for key, value in record.items():
        text = text.replace(f"@{{{key}}}", value)
    return text


def _defines(
    library: Library, request: Request, lists: Mapping[str, tuple[Record, ...]]
) -> dict[str, float]:
    """Every name that `#if` may use: stages, counts, parameters, optional functions."""
    defines = {"VERTEX": 0.0, "FRAGMENT": 0.0, request.stage: 1.0}
    defines.update({f"{name[:-1]}_COUNT": float(len(records)) for name, records in lists.items()})
    defines.update({name.upper(): value for name, value in request.values.items()})
    for name, folder in library.folders.items():
        file = library.files[f"{name}/{request.choices[folder.setting]}.glsl"]
        for signature in folder.optional:
            function = signature.split("(")[0].split()[-1]
            define = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", function).upper()
            defines[define] = float(function in file.functions)
    return defines
