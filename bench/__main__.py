"""`make bench`: what a frame of the box room costs, offline and in Chromium, beside three.js.

And what a ray costs, beside Mitsuba 3.
"""

import argparse

from bench.browser import AS_NEEDED, benching
from bench.figures import Figure, table
from bench.offline import frames, in_turn
from bench.rays import report
from bench.thesis import SETTINGS, comparison
from tests.browser import BACKENDS

SIZES = ((512, 512), (1280, 720))
TABLE = "Table 5.1 of the thesis, box-room with shadows"
MODELS = ["lambert", "phong", "blinn_phong", "cook_torrance"]
MATERIALS = ["MeshPhongMaterial", "MeshStandardMaterial"]
# The models that do the same work as three.js's two materials.
PEERS = {"MeshPhongMaterial": "blinn_phong", "MeshStandardMaterial": "cook_torrance"}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m bench")
    parser.add_argument("--frames", type=int, default=40, help="frames of each row")
    parser.add_argument("--offline", action="store_true", help="leave the browsers out")
    arguments = parser.parse_args()
    rows = [frames("box-room", {"model": m}, s, arguments.frames) for s in SIZES for m in MODELS]
    print(table("box-room offline: ms per frame, median (quartiles)", rows))
    rows = in_turn("box-room", SETTINGS, SIZES[1], arguments.frames)
    print(comparison(f"{TABLE} offline: ms per frame, median (quartiles)", rows))
    backends = () if arguments.offline else tuple(BACKENDS)
    print(report(backends))
    for backend in backends:
        with benching(backend) as bench:
            for size in SIZES:
                rows = bench.measure(MODELS[1:], MATERIALS, size, arguments.frames)
                print(table(f"box-room in Chromium on {backend}", rows))
                compare(rows)
                print()
            rows = bench.in_turn("box-room", SETTINGS, SIZES[1], arguments.frames)
            print(comparison(f"{TABLE} in Chromium on {backend}", rows))


def compare(rows: list[Figure]) -> None:
    """How many times three.js's frame is longer than ours."""
    medians = {row.what: row.median for row in rows}
    for material, model in PEERS.items():
        peer = medians[f"three.js {material}"]
        same, lean = (medians[f"ours {model}{detail}"] for detail in ("", AS_NEEDED))
        print(
            f"  {material} / {model}: {peer / same:.2f} on the same triangles, "
            f"{peer / lean:.2f} with detail as needed"
        )


if __name__ == "__main__":
    main()
