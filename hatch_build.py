"""Wheel build hook: puts shaders, scenes and the built playground into lightbench/_data."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

DATA = {"shaders": "shaders", "scenes": "scenes", "web/dist": "web"}


class DataHook(BuildHookInterface[Any]):
    """An editable install reads the checkout itself, so it gets no data and needs no npm."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if version == "editable":
            return
        root = Path(self.root)
        if not (root / "web/dist/index.html").is_file():
            self._build_playground(root / "web")
        for source, name in DATA.items():
            build_data["force_include"][str(root / source)] = f"lightbench/_data/{name}"

    def _build_playground(self, web: Path) -> None:
        npm = shutil.which("npm")
        if npm is None:
            self.app.abort("The playground is not built and npm is missing: install Node >= 20.19.")
            return
        for command in ([npm, "ci"], [npm, "run", "build"]):
            if subprocess.run(command, cwd=web, check=False).returncode:
                self.app.abort(f"`npm {' '.join(command[1:])}` failed in web/ (output above).")
