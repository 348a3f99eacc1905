"""From a scene and settings to the ordered passes, as plain data; no GL in it.

web/src/core/plan.ts is this module's twin: same scene and settings, same plan.
"""

import math
from collections.abc import Mapping, Sequence

from lightbench.batches import Batches
from lightbench.errors import LightbenchError, ShaderError
from lightbench.expression import Value, evaluate
from lightbench.front_matter import Pass, Target
from lightbench.library import Library
from lightbench.plan_types import Plan, PlannedPass
from lightbench.scene import Scene
from lightbench.settings import Resolved, Setting, resolve
from lightbench.values import float32
from lightbench.viewpoint import LightMap, light_map

__all__ = ["plan"]

MAX_SIDE = 16384
# Texture units that WebGL2 promises to a fragment shader.
MAX_UNITS = 16


def plan(
    library: Library,
    scene: Scene,
    settings: Mapping[str, Setting],
    size: tuple[int, int],
    attachment: str = "linear",
) -> Plan:
    """The plan of a picture of `size` (width, height) pixels.

    `attachment` is what to hand out as the linear picture: any texture that a pass writes. Raises
    SettingError, SceneError or ShaderError with what is wrong and what is allowed.
    """
    width, height = size
    if not (1 <= width <= MAX_SIDE and 1 <= height <= MAX_SIDE):
        raise LightbenchError(f"size {width}x{height}: each side is 1 to {MAX_SIDE} pixels")
    return _Planner(library, resolve(library, scene, settings), size).plan(attachment)


class _Planner:
    """Walks back from the outputs: a pass runs because something reads what it writes."""

    def __init__(self, library: Library, resolved: Resolved, size: tuple[int, int]) -> None:
        self.library, self.resolved, self.size = library, resolved, size
        self.scene = resolved.scene
        self.names: dict[str, Value] = {
            **{k: v for k, v in resolved.values.items() if isinstance(v, float | int)},
            **resolved.choices,
            "parts": len(self.scene.parts),
        }
        self.metas = library.passes()
        self.maps: dict[int, LightMap] = {}
        self.texture_of: dict[str, str] = {}
        self.map_of: dict[tuple[str, str], str] = {}
        self.under_way: list[str] = []
        view = library.files[f"views/{resolved.choices['view']}.glsl"]
        self.inspects = len(view.functions) > 1
        self.result: Plan = {
            "size": list(size), "targets": {}, "textures": {}, "arrays": {}, "tables": {},
            "programs": [], "passes": [],
            "outputs": {}, "signed": view.meta.signed, "settings": [], "files": [],
        }  # fmt: skip
        self.batches = Batches(library, resolved, self.result)

    def plan(self, attachment: str) -> Plan:
        for output, resource in (("linear", attachment), ("display", "display")):
            self.result["outputs"][output] = self.only(resource)
        return self.result

    def only(self, resource: str) -> str:
        """The one texture of a resource, or that of one of its lights as in `shadow_map.1`."""
        name, _, light = resource.partition(".")
        known = sorted({written for meta in self.metas.values() for written in meta.writes})
        if name not in known:
            raise LightbenchError(f"no attachment '{name}'; there is: {', '.join(known)}")
        if not self.library.per_light(name) and not light:
            return self.produce(name)
        casting = [str(i) for i, lamp in enumerate(self.scene.lights.values()) if lamp.casts]
        if not self.library.per_light(name) or light not in casting:
            known = [f"{name}.{key}" for key in casting] if self.library.per_light(name) else [name]
            raise LightbenchError(f"no attachment '{resource}'; there is: {', '.join(known)}")
        return self.maps_of(name, [light])[light]

    def runs(self, meta: Pass) -> bool:
        return not meta.when or bool(evaluate(meta.when, self.names))

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
        """Run the pass that makes `resource`; one left out hands on its first read instead.

        A pass that runs by its own condition stands above those that have none.
        """
        active = [name for name, meta in creators.items() if self.runs(meta)]
        if len(active) > 1:
            active = [name for name in active if creators[name].when] or active
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
        samplers = {}
        for read, lights in self.batches.reads(name, meta).items():
            if self.library.per_light(read):
                maps = self.maps_of(read, lights)
                samplers.update({f"u_{read}{light}": target for light, target in maps.items()})
            else:
                samplers[f"u_{read}"] = own.get(read) or self.produce(read)
        scale = float(evaluate(spec.scale, self.names))
        size = [max(1, math.floor(side * scale + 0.5)) for side in self.size]
        self.target(target, spec, size)
        planned = self.planned(name, meta, target, spec)
        planned["batches"] = self.batches.of_frame(name, meta, size, self.maps)
        planned["samplers"] = samplers
        _check_units(planned)
        self.result["passes"].append(planned)

    def maps_of(self, resource: str, lights: Sequence[str]) -> dict[str, str]:
        """The textures of a resource that each light has its own of, by the light's index."""
        for light in lights:
            if (resource, light) not in self.map_of:
                self.add_map(resource, int(light))
        return {light: self.map_of[resource, light] for light in lights}

    def add_map(self, resource: str, index: int) -> None:
        """Append the pass that draws what one light sees."""
        name, meta = next((n, m) for n, m in self.metas.items() if resource in m.writes)
        spec = meta.writes[resource]
        side = int(float(evaluate(spec.side, self.names)))
        made = light_map(self.scene, list(self.scene.lights.values())[index], side)
        self.maps[index] = made
        target = f"{resource}.{index}"
        self.target(target, spec, [tiles * side for tiles in made.tiles])
        planned = self.planned(name, meta, target, spec)
        planned["batches"] = self.batches.of_map(name, meta, index, made)
        self.result["passes"].append(planned)
        self.map_of[resource, str(index)] = target

    def target(self, name: str, spec: Target, size: list[int]) -> None:
        self.result["targets"][name] = {"size": size, "format": spec.format, "depth": spec.depth}

    def planned(self, name: str, meta: Pass, target: str, spec: Target) -> PlannedPass:
        # A view of what objects are shows nothing where there is none.
        behind = (0.0, 0.0, 0.0) if self.inspects else self.scene.background
        clear = [*behind, 1.0] if spec.clear == "background" else spec.clear
        return {
            "name": name,
            "target": target,
            "clear": float32(map(float, clear)) if meta.draw == "objects" else None,
            "keep": meta.keep,
            "samplers": {},
            "batches": [],
        }


def _check_units(planned: PlannedPass) -> None:
    draws = [draw for batch in planned["batches"] for draw in batch["draws"]]
    own = max(
        (sum(len(draw[kind]) for kind in ("textures", "arrays", "tables")) for draw in draws),
        default=0,
    )
    if len(planned["samplers"]) + own > MAX_UNITS:
        raise LightbenchError(
            f"{planned['name']}: {len(planned['samplers'])} shadow maps or targets and {own} "
            f"textures of a material at once; a shader has at most {MAX_UNITS}: let fewer lights "
            "cast shadows"
        )
