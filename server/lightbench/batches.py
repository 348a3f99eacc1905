"""The draws of a pass: which programs its objects need, in which state, with which numbers."""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from itertools import groupby

from lightbench.assemble import Record, Request, Source, assemble
from lightbench.constants import with_constants
from lightbench.errors import ShaderError
from lightbench.front_matter import Pass
from lightbench.library import Library
from lightbench.link import link
from lightbench.parts import part_records, part_values
from lightbench.plan_types import Batch, Draw, Plan, PlannedTable, Program, Sampling, Uniforms
from lightbench.scene import Object, Scene
from lightbench.scene_lights import Light, SpotLight
from lightbench.scene_surfaces import Texture
from lightbench.settings import Resolved
from lightbench.surface import NO_PATTERN, Pattern, surface
from lightbench.traced import (
    SURFACE,
    TRACING,
    UNTRACED,
    UNTRACED_LISTS,
    Records,
    image_arrays,
    image_numbers,
    object_list,
    object_records,
    object_values,
    own_values,
    patterns_of,
    scene_defines,
    taken,
    texels_of,
)
from lightbench.values import (
    DRAW_NAMES,
    draw_values,
    float32,
    frame_values,
    front_to_back,
    light_values,
    map_values,
    mesh_key,
    parameter_values,
    texture_transform,
)
from lightbench.viewpoint import (
    WIDEST_SPOT,
    LightMap,
    Viewpoint,
    camera_viewpoint,
    in_sight,
)

__all__ = ["Batches", "ById", "define_values", "light_lists"]

NO_LISTS: Mapping[str, Records] = {}


class ById:
    """A library as a cache key: a library read once is one object."""

    def __init__(self, value: Library) -> None:
        self.value = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ById) and other.value is self.value

    def __hash__(self) -> int:
        return id(self.value)


@lru_cache(maxsize=1024)
def _assembled(
    library: ById, entry: str, stage: str, choices: tuple[tuple[str, str], ...],
    values: tuple[tuple[str, float], ...], lights: Records, lists: tuple[tuple[str, Records], ...],
    own: int | None, pattern: Pattern, varyings: tuple[str, ...],
) -> Source:  # fmt: skip
    more = {name: tuple(dict(record) for record in records) for name, records in lists}
    records = light_lists(lights, own) | more
    request = Request(entry, stage, dict(choices), dict(values), records, pattern, varyings)
    return assemble(library.value, request)


def light_lists(lights: Records, own: int | None = None) -> dict[str, tuple[Record, ...]]:
    """The lists of `#for` over lights; `own` is the light whose map a pass draws."""
    every = tuple(dict(record) for record in lights)
    return {
        "LIGHTS": every,
        "POSITIONAL_LIGHTS": tuple(r for r in every if r["positional"] == "1"),
        "SPOT_LIGHTS": tuple(r for r in every if r["spot"] == "1"),
        "CASTERS": tuple(r for r in every if r["casts"] == "1"),
        "OWN_LIGHTS": () if own is None else (every[own],),
    }


def light_records(scene: Scene) -> Records:
    """The records of LIGHTS: which light, of which kind; the kinds are 0 or 1 for `#if`."""
    return tuple(
        tuple(_record(index, light).items()) for index, light in enumerate(scene.lights.values())
    )


def _record(index: int, light: Light) -> dict[str, str]:
    cube = light.type == "point" or (isinstance(light, SpotLight) and light.outer > WIDEST_SPOT)
    kinds = {
        "point": light.type == "point",
        "directional": light.type == "directional",
        "spot": light.type == "spot",
        "positional": light.type != "directional",
        "casts": light.casts,
        "cube": cube,
    }
    return {"index": str(index), **{kind: str(int(holds)) for kind, holds in kinds.items()}}


def define_values(library: Library, resolved: Resolved) -> tuple[tuple[str, float], ...]:
    """The parameters that become defines: whole numbers and truths; and what the frame is."""
    numbers = tuple(
        (name, float(str(resolved.values[name])))
        for file in library.files.values()
        for name, parameter in file.meta.parameters.items()
        if parameter.kind in ("int", "bool") and name in resolved.values
    )
    chosen = (f"{n}/{resolved.choices[f.setting]}.glsl" for n, f in library.folders.items())
    signed = any(library.files[path].meta.signed for path in chosen)
    orthographic = resolved.scene.camera.projection == "orthographic"
    frame = (("orthographic", float(orthographic)), ("signed", float(signed)))
    bounces = float(str(resolved.values.get("max_bounces", 0)))
    return (*numbers, *frame, *scene_defines(resolved.scene, bounces))


class Batches:
    """Makes the batches of passes, and notes the programs and textures they need in the plan."""

    def __init__(self, library: Library, resolved: Resolved, result: Plan) -> None:
        self.library, self.resolved, self.result = library, resolved, result
        self.scene = resolved.scene
        self.defines = define_values(library, resolved)
        self.lights = light_records(self.scene)
        self.index = {id(thing): i for i, thing in enumerate(self.scene.objects.values())}
        self.parameters = parameter_values(resolved)
        self.surfaces = {
            id(thing): surface(library, self.scene, thing) for thing in self.scene.objects.values()
        }
        self.things = object_records(self.scene, self.surfaces)
        kinds = len(patterns_of(self.scene, self.surfaces))
        names = (f"SURFACE{i}_VALUES" for i in range(kinds))
        self.no_values: dict[str, Records] = dict.fromkeys(names, ())
        # What each object has its own value of, where rays ask.
        self.own: Records = ()
        # Names of textures, array by array, that rays read.
        self.images: list[list[str]] = []
        # Uniforms of each program of the plan, with their types.
        self.declared: list[Mapping[str, str]] = []
        # The programs that rays begin in.
        self.tracers: set[int] = set()

    def reads(self, name: str, meta: Pass) -> dict[str, list[str]]:
        """What the files of a pass read and its code names: the lights of each, "" for none."""
        indices = ["", *(dict(record)["index"] for record in self.lights)]
        found: dict[str, dict[str, None]] = {}
        for pattern in self.patterns(meta):
            for source in self.sources(name, meta, pattern, None):
                for read in (r for p in source.files for r in self.library.files[p].meta.reads):
                    live = [i for i in indices if f"u_{read}{i}" in source.uniforms]
                    if live:
                        found.setdefault(read, {}).update(dict.fromkeys(live))
        return {read: list(keys) for read, keys in found.items()}

    def of_frame(
        self, name: str, meta: Pass, size: Sequence[int], maps: Mapping[int, LightMap]
    ) -> list[Batch]:
        """The batches of a pass that draws the camera's picture, or the screen."""
        viewpoint = camera_viewpoint(self.scene, size)
        shared = {
            **self.parameters,
            **frame_values(viewpoint, self.scene, size),
            **light_values(self.resolved, self.library, maps, self.scene.camera.eye),
            **part_values(self.scene),
        }
        if meta.draw == "screen":
            program = self.program(name, meta, NO_PATTERN, None)
            declared = self.declared[program]
            draws: list[Draw] = [{
                "mesh": None, "uniforms": {}, "textures": {}, "arrays": self.arrays_of(declared),
                "tables": self.tables_of(declared),
            }]  # fmt: skip
            batch = self.batch(name, program, shared, draws, blend=None, rays=True)
            if program in self.tracers and self.resolved.values.get("constants"):
                self.settle(batch)
            return [batch]
        things = front_to_back(self.scene, viewpoint.origin)
        return self.objects(name, meta, things, viewpoint, shared, None)

    def settle(self, batch: Batch) -> None:
        """Give the program of a batch that is the only one to run it its uniforms as constants."""
        program = self.result["programs"][batch["program"]]
        program["fragment"] = with_constants(program["fragment"], batch["uniforms"])
        batch["uniforms"] = {}

    def seen_by_rays(self) -> Uniforms:
        numbers = image_numbers(self.images)
        return object_values(self.scene, self.surfaces, numbers, self.scene.camera.eye)

    def arrays_of(self, declared: Mapping[str, str]) -> dict[str, str]:
        """The arrays of images that a program reads, by sampler."""
        samplers = {}
        for index, names in enumerate(self.images):
            if f"u_images{index}" in declared:
                textures = [self.scene.textures[name] for name in names]
                images = [texture.image for texture in textures]
                self.result["arrays"][f"images{index}"] = {
                    "images": images, **self.sampling(textures[0]), "anisotropy": 1,
                }  # fmt: skip
                samplers[f"u_images{index}"] = f"images{index}"
        return samplers

    def tables_of(self, declared: Mapping[str, str]) -> dict[str, str]:
        """The tables that a program reads, by sampler."""
        found = [name for name in ("objects", "meshes") if f"u_{name}" in declared]
        things = self.scene.objects.values()
        meshes = list(dict.fromkeys(self.scene.meshes[t.mesh].mesh for t in things if t.mesh))
        for name in found:
            if name in self.result["tables"]:
                continue
            texels = list[float]()
            if name == "objects":
                texels = object_list(
                    self.scene, self.surfaces, self.seen_by_rays(), self.own, meshes
                )
            table: PlannedTable = {"texels": texels, "meshes": meshes if name == "meshes" else []}
            self.result["tables"][name] = table
        return {f"u_{name}": name for name in found}

    def of_map(self, name: str, meta: Pass, index: int, light: LightMap) -> list[Batch]:
        """The batches of a pass that draws a light's map, face after face."""
        batches = []
        for face in light.faces:
            near = front_to_back(self.scene, face.origin)
            things = [thing for thing in near if in_sight(self.scene, face, thing)]
            shared = {**self.parameters, **map_values(face, light)}
            batches += self.objects(name, meta, things, face, shared, index)
        return batches

    def objects(
        self, name: str, meta: Pass, things: Sequence[Object], viewpoint: Viewpoint,
        shared: Uniforms, own: int | None,
    ) -> list[Batch]:  # fmt: skip
        """Opaque objects by pattern, the nearest first; then blended ones, the farthest first."""
        solid = [t for t in things if "BLEND" not in self.surfaces[id(t)].pattern.flags]
        clear = [t for t in reversed(things) if "BLEND" in self.surfaces[id(t)].pattern.flags]
        groups: dict[Pattern, list[Object]] = {}
        for thing in solid:
            groups.setdefault(self.surfaces[id(thing)].pattern, []).append(thing)
        blend = None if meta.blend == "over" else meta.blend
        runs: list[tuple[Pattern, list[Object], str | None]] = [
            (pattern, group, None if blend == "none" else blend)
            for pattern, group in groups.items()
        ]
        if meta.blend != "none":
            by_pattern = groupby(clear, key=lambda thing: self.surfaces[id(thing)].pattern)
            runs += [(pattern, list(group), meta.blend) for pattern, group in by_pattern]
        batches = []
        for pattern, group, blended in runs:
            program = self.program(name, meta, pattern, own)
            draws = [self.draw(program, thing, viewpoint) for thing in group]
            batch = self.batch(name, program, shared, draws, blend=blended, rays=own is None)
            batch["tile"] = viewpoint.tile
            # A mirrored camera turns every triangle over.
            mirrored = self.scene.camera.mirrored and own is None
            batch["cull"] = "DOUBLE_SIDED" not in pattern.flags and not mirrored
            batches.append(batch)
        return batches

    def batch(
        self, name: str, program: int, shared: Uniforms, draws: list[Draw], *,
        blend: str | None, rays: bool,
    ) -> Batch:  # fmt: skip
        """`rays`: the program may ask for what rays know of every object."""
        wanted = {n for n, kind in self.declared[program].items() if "sampler" not in kind}
        own = DRAW_NAMES | {n for draw in draws for n in draw["uniforms"]}
        if rays and not wanted <= own | set(shared):
            shared = {**shared, **self.seen_by_rays()}
        if unknown := wanted - own - set(shared):
            known = ", ".join(sorted([*shared, *DRAW_NAMES]))
            raise ShaderError(
                f"passes/{name}.glsl:1: uniform {min(unknown)} has no value; known are: {known}"
            )
        uniforms = {n: shared[n] for n in sorted(wanted - own)}
        return {
            "program": program, "tile": None, "cull": True, "blend": blend,
            "uniforms": uniforms, "draws": draws,
        }  # fmt: skip

    def draw(self, program: int, thing: Object, viewpoint: Viewpoint) -> Draw:
        declared = self.declared[program]
        values = draw_values(self.scene, thing, viewpoint.origin)
        texels = self.surfaces[id(thing)].texels
        textures = {
            f"u_texture{i}": used.texture
            for i, used in enumerate(texels)
            if f"u_texture{i}" in declared
        }
        mesh, gap = mesh_key(self.resolved, self.library, thing, viewpoint)
        values["u_gap"] = float32([gap])
        values["u_object"] = [float(self.index[id(thing)])]
        for i, used in enumerate(texels):
            values[f"u_texture{i}_transform"] = texture_transform(used)
        for texture in textures.values():
            self.note_texture(texture)
        return {
            "mesh": mesh,
            "uniforms": {n: values[n] for n in sorted(values) if n in declared},
            "textures": textures,
            "arrays": {},
            "tables": self.tables_of(declared),
        }

    def note_texture(self, name: str) -> None:
        texture = self.scene.textures[name]
        self.result["textures"][name] = {"image": texture.image, **self.sampling(texture)}

    def sampling(self, texture: Texture) -> Sampling:
        return {
            "encoding": texture.encoding,
            "wrap": list(texture.wrap),
            "filter": texture.filter,
            "anisotropy": int(float(str(self.resolved.values["anisotropy"]))),
        }

    def patterns(self, meta: Pass) -> list[Pattern]:
        """Every pattern that the pass draws."""
        if meta.draw == "screen":
            return [NO_PATTERN]
        found = dict.fromkeys(surface.pattern for surface in self.surfaces.values())
        return [p for p in found if meta.blend != "none" or "BLEND" not in p.flags]

    def sources(self, name: str, meta: Pass, pattern: Pattern, own: int | None) -> list[Source]:
        """The fragment and the vertex stage of a pass for surfaces of a pattern."""
        entry, values = f"passes/{name}.glsl", {"draws_objects": meta.draw == "objects"}
        fragment = self.assembled(entry, "FRAGMENT", pattern, values, own=own)
        if TRACING in fragment.files:
            fragment = self.tracing(entry)
        varyings = fragment.varyings
        vertex = self.assembled(entry, "VERTEX", pattern, values, own=own, varyings=varyings)
        return [fragment, vertex]

    def assembled(
        self, entry: str, stage: str, pattern: Pattern, values: Mapping[str, float],
        lists: Mapping[str, Records] = NO_LISTS, own: int | None = None,
        varyings: tuple[str, ...] = (),
    ) -> Source:  # fmt: skip
        choices = tuple({**self.resolved.choices, **dict(pattern.choices)}.items())
        given = {**UNTRACED, "record": texels_of(self.own), **values}
        defines = (*self.defines, *((n, float(value)) for n, value in given.items()))
        nearest = [self.scene.textures[names[0]].filter == "nearest" for names in self.images]
        arrays: Records = tuple(
            (("index", str(i)), ("nearest", str(int(holds)))) for i, holds in enumerate(nearest)
        )
        every = {
            **UNTRACED_LISTS, **self.no_values, "OBJECTS": self.things, "IMAGE_ARRAYS": arrays,
            "PARTS": part_records(self.scene), **lists,
        }  # fmt: skip
        return _assembled(
            ById(self.library), entry, stage, choices, defines, self.lights, tuple(every.items()),
            own, pattern, varyings,
        )  # fmt: skip

    def tracing(self, entry: str) -> Source:
        """The fragment stage of a pass whose rays may meet every kind of surface."""
        values = {"draws_objects": 1.0, "traced": 1.0}
        patterns = patterns_of(self.scene, self.surfaces)
        # First to see what they read, which says what there must be to be read.
        self.images, self.own = [], ()
        parts = [self.assembled(SURFACE, "FRAGMENT", pattern, values) for pattern in patterns]
        self.images = image_arrays(
            self.scene, self.surfaces, dict(zip(patterns, parts, strict=True))
        )
        defines = dict(self.defines)
        self.own = own_values(defines, parts)
        parts = [self.assembled(SURFACE, "FRAGMENT", pattern, values) for pattern in patterns]
        by_kind = {
            f"SURFACE{i}_VALUES": own_values(defines, [part]) for i, part in enumerate(parts)
        }
        kinds: Records = tuple((("index", str(i)),) for i in range(len(parts)))
        main = self.assembled(
            entry, "FRAGMENT", NO_PATTERN, {"traced": 1.0, **dict(taken(parts))},
            {"OBJECT_VALUES": self.own, "SURFACES": kinds, **by_kind},
        )  # fmt: skip
        return link(
            parts, "surfaceLight", main, {f"u_{dict(record)['name']}" for record in self.own}
        )

    def program(self, name: str, meta: Pass, pattern: Pattern, own: int | None) -> int:
        """The index in the plan of the program for surfaces of a pattern."""
        fragment, vertex = self.sources(name, meta, pattern, own)
        made: Program = {
            "vertex": vertex.text,
            "fragment": fragment.text,
            "vertex_lines": list(vertex.lines),
            "fragment_lines": list(fragment.lines),
            "attributes": sorted(vertex.attributes),
        }
        programs = self.result["programs"]
        if made not in programs:
            programs.append(made)
            self.declared.append({**vertex.uniforms, **fragment.uniforms})
            if TRACING in fragment.files:
                self.tracers.add(len(programs) - 1)
            self.note("files", [*vertex.files, *fragment.files])
            self.note("settings", [*vertex.settings, *fragment.settings])
        return programs.index(made)

    def note(self, kept: str, found: Sequence[str]) -> None:
        """Record the choices and files in use: what the panel shows."""
        known = self.result[kept]  # type: ignore[literal-required]
        known.extend(item for item in dict.fromkeys(found) if item not in known)
