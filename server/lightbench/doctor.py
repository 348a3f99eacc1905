"""What this machine has for Lightbench, what is missing, and the command that installs it."""

import platform
import re
import shutil
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import metadata

import moderngl
import numpy as np

from lightbench.errors import LightbenchError
from lightbench.library import read_library
from lightbench.options import scenes, version
from lightbench.paths import scenes_folder, shaders_folder, web_folder
from lightbench.render import on_gl_thread, renderer

__all__ = ["Check", "checks"]

CHROMIUM = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
PROBE = 1234.5678
VERTEX = """#version 300 es
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(corner * 4.0 - 1.0, 0.0, 1.0);
}
"""
FRAGMENT = f"""#version 300 es
precision highp float;
out vec4 o_value;
void main() {{ o_value = vec4({PROBE}, -{PROBE}, 0.0, 1.0); }}
"""


@dataclass(frozen=True)
class Check:
    """One line of the report: what was found, or the command that mends it.

    Without something `needed` Lightbench does not work; what else is missing is worth knowing.
    """

    name: str
    ok: bool
    found: str
    command: str = ""
    needed: bool = True

    def __str__(self) -> str:
        state = "ok" if self.ok else "missing" if self.needed else "note"
        command = f"; run: {self.command}" if self.command and not self.ok else ""
        return f"{state:<8} {self.name:<11} {self.found}{command}"


def checks() -> Iterator[Check]:
    """Look at everything, one line each."""
    yield Check("Lightbench", True, f"{version()} on Python {platform.python_version()}")
    yield from _packages()
    yield from _opengl()
    yield _files("shaders", lambda: f"{len(read_library(shaders_folder()).files)} files in "
                 f"{shaders_folder()}")  # fmt: skip
    yield _files("scenes", lambda: f"{len(scenes(scenes_folder()))} in {scenes_folder()}")
    yield _playground()
    yield _chromium()
    yield _matplotlib()


def _packages() -> Iterator[Check]:
    found = []
    for requirement in metadata.requires("lightbench") or []:
        name = re.split(r"[^\w.-]", requirement)[0]
        if "extra ==" in requirement:
            continue
        try:
            found.append(f"{name} {metadata.version(name)}")
        except metadata.PackageNotFoundError:
            command = f"{sys.executable} -m pip install '{requirement}'"
            yield Check("package", False, f"{name} is not installed", command)
    yield Check("packages", True, ", ".join(found))


def _opengl() -> Iterator[Check]:
    drivers = _apt("libegl1 libgl1 libgl1-mesa-dri")
    try:
        info = on_gl_thread(lambda: dict(renderer().context.info))
    except LightbenchError as error:
        yield Check("OpenGL", False, str(error).split(";")[0], drivers)
        return
    names = [str(info[key]) for key in ("GL_RENDERER", "GL_VENDOR", "GL_VERSION")]
    yield Check("OpenGL", True, ", ".join(names))
    yield Check("textures", True, f"up to {info['GL_MAX_TEXTURE_SIZE']} pixels a side")
    problem = on_gl_thread(_probe)
    works = "#version 300 es compiles, RGBA32F renders"
    yield Check("GLSL ES 3", not problem, problem or works, drivers)


def _probe() -> str:
    """What fails when one float32 pixel is drawn and read back; runs on the GL thread."""
    context = renderer().context
    try:
        program = context.program(VERTEX, FRAGMENT)
        framebuffer = context.simple_framebuffer((1, 1), 4, dtype="f4")
    except moderngl.Error as error:
        return " ".join(str(error).split())
    framebuffer.use()
    context.vertex_array(program, []).render(moderngl.TRIANGLES, vertices=3)
    red, green = np.frombuffer(framebuffer.read(components=4, dtype="f4"), np.float32)[:2]
    exact = red == np.float32(PROBE) and green == -np.float32(PROBE)
    return "" if exact else f"RGBA32F gives {red} for {PROBE}"


def _files(name: str, describe: Callable[[], str]) -> Check:
    try:
        return Check(name, True, describe())
    except LightbenchError as error:
        return Check(name, False, str(error))


def _playground() -> Check:
    built = (web_folder() / "index.html").is_file()
    found = str(web_folder()) if built else "is not built"
    return Check("playground", built, found, "make web/dist/index.html")


def _chromium() -> Check:
    paths = [path for path in map(shutil.which, CHROMIUM) if path]
    found = paths[0] if paths else "not found; only the browser tests need it"
    return Check("Chromium", bool(paths), found, _apt("chromium"), needed=False)


def _matplotlib() -> Check:
    try:
        found, ok = metadata.version("matplotlib"), True
    except metadata.PackageNotFoundError:
        found, ok = "not found; only `lightbench atlas` draws with it", False
    command = f"{sys.executable} -m pip install 'matplotlib>=3.10,<4'"
    return Check("matplotlib", ok, found, command, needed=False)


def _apt(packages: str) -> str:
    return f"sudo apt-get install -y {packages}"
