"""From a scene and settings to the ordered passes, as plain data; no GL in it.

web/src/core/plan.ts is this module's twin: same scene and settings, same plan.
"""

import math
from collections.abc import Mapping
from functools import lru_cache

from typing_extensions import TypedDict

from lightbench.assemble import Record, Request, Source, assemble
from lightbench.errors import LightbenchError, ShaderError
from lightbench.expression import Value, evaluate
from lightbench.library import Library, Pass, Target
from lightbench.scene import Scene
from lightbench.settings import Resolved, Setting, resolve
from lightbench.values import draw_values, float32, frame_values, front_to_back, mesh_key

__all__ = ["Batch", "ById", "Draw", "Plan", "PlannedPass", "PlannedTarget", "Program", "plan"]

MAX_SIDE = 16384
# What a plan is made for: the linear picture and its display code.
OUTPUTS = ("linear", "display")
Uniforms = dict[str, list[float]]


class PlannedTarget(TypedDict):
    """A texture: `size` in pixels, `format` as in front matter, `depth` with a depth buffer."""

    size: list[int]
    format: str
    depth: bool


class Program(TypedDict):
    """Both specialised sources of a pass, where their lines come from, the attributes they read."""

    vertex: str
    fragment: str
    vertex_lines: list[str]
    fragment_lines: list[str]
    attributes: list[str]


class Draw(TypedDict):
    """One mesh (null: the screen triangle) and the uniforms that are its own."""

    mesh: str | None
    uniforms: Uniforms


class Batch(TypedDict):
    """The draws of one program, with the uniforms they share."""

    program: int
    uniforms: Uniforms
    draws: list[Draw]


class PlannedPass(TypedDict):
    """One pass: the target it writes, its clear colour (null: none), samplers by target."""

    name: str
    target: str
    clear: list[float] | None
    samplers: dict[str, str]
    batches: list[Batch]


class Plan(TypedDict):
    """All that a renderer needs, and what the panel shows (`settings`, `files`)."""

    size: list[int]
    targets: dict[str, PlannedTarget]
    programs: list[Program]
    passes: list[PlannedPass]
    outputs: dict[str, str]
    settings: list[str]
    files: list[str]


def plan(
    library: Library, scene: Scene, settings: Mapping[str, Setting], size: tuple[int, int]
) -> Plan:
    """The plan of a picture of `size` (width, height) pixels.

    Raises SettingError, SceneError or ShaderError with what is wrong and what is allowed.
    """
    width, height = size
    if not (1 <= width <= MAX_SIDE and 1 <= height <= MAX_SIDE):
        raise LightbenchError(f"size {width}x{height}: each side is 1 to {MAX_SIDE} pixels")
    return _Planner(library, resolve(library, scene, settings), size).plan()


@lru_cache(maxsize=512)
def _assembled(
    library: "ById", entry: str, stage: str, choices: tuple[tuple[str, str], ...],
    values: tuple[tuple[str, float], ...], lights: tuple[tuple[tuple[str, str], ...], ...],
) -> Source:  # fmt: skip
    every = tuple(dict(record) for record in lights)
    records: dict[str, tuple[Record, ...]] = {
        "LIGHTS": every,
        "POSITIONAL_LIGHTS": tuple(r for r in every if r["positional"] == "1"),
        "SPOT_LIGHTS": tuple(r for r in every if r["spot"] == "1"),
    }
    request = Request(entry, stage, dict(choices), dict(values), records)
    return assemble(library.value, request)


class ById:
    """A library as a cache key: a library read once is one object."""

    def __init__(self, value: Library) -> None:
        self.value = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ById) and other.value is self.value

    def __hash__(self) -> int:
        return id(self.value)


def light_records(scene: Scene) -> tuple[tuple[tuple[str, str], ...], ...]:
    """The records of LIGHTS: which light, of which kind; the kinds are 0 or 1 for `#if`."""
    kinds = ("point", "directional", "spot")
    return tuple(
        (
            ("index", str(i)),
            *((kind, str(int(light.type == kind))) for kind in kinds),
            ("positional", str(int(light.type != "directional"))),
        )
        for i, light in enumerate(scene.lights.values())
    )


def define_values(library: Library, resolved: Resolved) -> tuple[tuple[str, float], ...]:
    """The parameters that become defines: whole numbers and truths."""
    return tuple(
        (name, float(str(resolved.values[name])))
        for file in library.files.values()
        for name, parameter in file.meta.parameters.items()
        if parameter.kind in ("int", "bool") and name in resolved.values
    )


class _Planner:
    """Walks back from the outputs: a pass runs because something reads what it writes."""

    def __init__(self, library: Library, resolved: Resolved, size: tuple[int, int]) -> None:
        self.library, self.resolved, self.size = library, resolved, size
        self.scene = resolved.scene
        self.names: dict[str, Value] = {
            **{k: v for k, v in resolved.values.items() if isinstance(v, float | int)},
            **resolved.choices,
        }
        self.defines = define_values(library, resolved)
        self.metas = library.passes()
        self.texture_of: dict[str, str] = {}
        self.under_way: list[str] = []
        self.result: Plan = {
            "size": list(size), "targets": {}, "programs": [], "passes": [], "outputs": {},
            "settings": [], "files": [],
        }  # fmt: skip

    def plan(self) -> Plan:
        for output in OUTPUTS:
            self.result["outputs"][output] = self.produce(output)
        return self.result

    def runs(self, meta: Pass) -> bool:
        return bool(evaluate(meta.when, self.names))

    def produce(self, resource: str) -> str:
        """The texture that holds `resource` once its writer and all that refine it have run."""
        if resource in self.texture_of:
            return self.texture_of[resource]
        if resource in self.under_way:
            chain = " -> ".join([*self.under_way, resource])
            raise ShaderError(f"passes: '{resource}' is read before it is written: {chain}")
        self.under_way.append(resource)
        writers = {n: m for n, m in self.metas.items() if resource in m.writes}
        refiners = {n: m for n, m in writers.items() if resource in m.reads}
        texture = self.create(resource, {n: m for n, m in writers.items() if n not in refiners})
        for name, meta in refiners.items():
            if self.runs(meta):
                target = f"{resource}~{name}"
                self.add(name, meta, target, meta.writes[resource], {resource: texture})
                texture = target
        self.under_way.pop()
        self.texture_of[resource] = texture
        return texture

    def create(self, resource: str, creators: Mapping[str, Pass]) -> str:
        """Run the pass that makes `resource`; one left out hands on its first read instead."""
        active = [name for name, meta in creators.items() if self.runs(meta)]
        if len(active) > 1:
            raise ShaderError(f"passes: '{resource}' is written by {' and '.join(active)}")
        if active:
            meta = creators[active[0]]
            self.add(active[0], meta, resource, meta.writes[resource], {})
            return resource
        for meta in creators.values():
            if meta.reads:
                return self.produce(meta.reads[0])
        raise ShaderError(f"passes: nothing writes '{resource}'; passes: {', '.join(self.metas)}")

    def add(self, name: str, meta: Pass, target: str, spec: Target, own: Mapping[str, str]) -> None:
        """Append the pass after all that it reads; `own` says which texture it refines."""
        stages = [self.assemble(name, stage) for stage in ("VERTEX", "FRAGMENT")]
        files = list(dict.fromkeys(path for source in stages for path in source.files))
        uniforms = {**stages[0].uniforms, **stages[1].uniforms}
        reads = dict.fromkeys(r for path in files for r in self.library.files[path].meta.reads)
        samplers = {
            f"u_{r}": own[r] if r in own else self.produce(r) for r in reads if f"u_{r}" in uniforms
        }
        scale = float(evaluate(spec.scale, self.names))
        size = [max(1, math.floor(side * scale + 0.5)) for side in self.size]
        self.result["targets"][target] = {"size": size, "format": spec.format, "depth": spec.depth}
        program = self.program(stages)
        self.result["passes"].append({
            "name": name,
            "target": target,
            "clear": float32([*self.scene.background, 1.0]) if meta.draw == "objects" else None,
            "samplers": samplers,
            "batches": [self.batch(name, meta, program, set(uniforms) - set(samplers), size)],
        })  # fmt: skip
        self.note(files, stages)

    def assemble(self, name: str, stage: str) -> Source:
        choices = tuple(self.resolved.choices.items())
        entry = f"passes/{name}.glsl"
        lights = light_records(self.scene)
        return _assembled(ById(self.library), entry, stage, choices, self.defines, lights)

    def program(self, stages: list[Source]) -> int:
        program: Program = {
            "vertex": stages[0].text,
            "fragment": stages[1].text,
            "vertex_lines": list(stages[0].lines),
            "fragment_lines": list(stages[1].lines),
            "attributes": sorted(stages[0].attributes),
        }
        self.result["programs"].append(program)
        return len(self.result["programs"]) - 1

    def batch(
        self, name: str, meta: Pass, program: int, wanted: set[str], size: list[int]
    ) -> Batch:
        shared = frame_values(self.resolved, self.library, size)
        draws: list[Draw] = [{"mesh": None, "uniforms": {}}]
        own: set[str] = set()
        if meta.draw == "objects":
            own = set(draw_values(self.scene, None)) & wanted
            draws = [
                {
                    "mesh": mesh_key(self.resolved, self.library, thing, size),
                    "uniforms": _only(own, draw_values(self.scene, thing)),
                }
                for thing in front_to_back(self.scene)
            ]
        if unknown := wanted - own - set(shared):
            known = ", ".join(sorted([*shared, *draw_values(self.scene, None)]))
            raise ShaderError(
                f"passes/{name}.glsl:1: uniform {min(unknown)} has no value; known are: {known}"
            )
        return {"program": program, "uniforms": _only(wanted - own, shared), "draws": draws}

    def note(self, files: list[str], stages: list[Source]) -> None:
        """Record the choices and files in use: what the panel shows."""
        settings = (setting for source in stages for setting in source.settings)
        for kept, found in (("settings", settings), ("files", files)):
            known = self.result[kept]  # type: ignore[literal-required]
            known.extend(item for item in dict.fromkeys(found) if item not in known)


def _only(names: set[str], values: Mapping[str, list[float]]) -> Uniforms:
    return {name: values[name] for name in sorted(names)}
