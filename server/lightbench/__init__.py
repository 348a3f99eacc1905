"""Lightbench: a bench for light. The picture, what it costs, and how far it is from the truth."""

from collections.abc import Mapping

from lightbench import glsl
from lightbench.errors import LightbenchError
from lightbench.gltf import Limits
from lightbench.image import Image
from lightbench.library import read_library
from lightbench.paths import scenes_folder, shaders_folder
from lightbench.plan import plan
from lightbench.render import on_gl_thread, renderer
from lightbench.scene import Scene
from lightbench.scene_file import read_scene
from lightbench.settings import Setting

__all__ = ["Image", "LightbenchError", "Scene", "glsl", "load", "render"]


def load(name_or_path: str, limits: Limits | None = None) -> Scene:
    """A preset by its name (`box-room`), a scene `.json` or a glTF model (`.glb`, `.gltf`) by path.

    `limits` bound the size of a model. Raises NotFoundError, SceneError or ModelError.
    """
    return read_scene(name_or_path, scenes_folder(), limits)


def render(scene: Scene | str, size: tuple[int, int] | None = None, **settings: Setting) -> Image:
    """Render a scene, or the one of that name, at `size` (width, height) pixels.

    A scene may have a size of its own; else it is (640, 480).
    Settings are those of `lightbench options`, and the scene's own by their path, as in
    `render(scene, **{"lights.key.intensity": 3.0})`. Raises LightbenchError.
    """
    if isinstance(scene, str):
        scene = load(scene)
    return render_plan(scene, size or scene.sized(), settings)


def render_plan(
    scene: Scene, size: tuple[int, int], settings: Mapping[str, Setting], attachment: str = "linear"
) -> Image:
    """Plan and run on the GL thread; `attachment` is what is handed out as the linear picture."""
    planned = plan(read_library(shaders_folder()), scene, settings, size, attachment)
    return on_gl_thread(lambda: renderer().run(planned))
