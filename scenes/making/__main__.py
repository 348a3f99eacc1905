"""`python -m scenes.making [FOLDER]`: write all textures and the room into the scenes' folder."""

from __future__ import annotations

import sys
from pathlib import Path

from scenes.making.room import make_room
from scenes.making.textures import make_all


def main() -> None:
    """Write everything and name each file with its size."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1]
    files = [*make_all(folder / "textures"), *make_room(folder / "model-room.gltf")]
    for path in files:
        print(f"{path.stat().st_size:>9,}  {path.relative_to(folder)}")


if __name__ == "__main__":
    main()
