"""Prints runway.m3d as the pilot sees it at a distance from the runway's centre, to be piped into another command:

    python examples/approach.py 2.68 | m3d-render - -o approach.png

The observer glides down 2.5 m a kilometre, from 8 m at 3.4 km, and so is at 7, 6.2, 6, 5, 4 and 3 m at 3, 2.68, 2.6,
2.2, 1.8 and 1.4 km: the six stills of Robinson 1993, section 6.2. With --fov the view is another than the scene's 14
degrees wide, and with --level it is horizontal, as one needs it to read mirages of some arcminutes.
"""

import argparse
import re
from pathlib import Path

RUNWAY = Path(__file__).parent / "runway.m3d"
VIEW = re.compile(r"FROM < 3000, 0, 7 > TO < 0, 0, 0 > FOV 14 ")


def elevation(distance: float) -> float:
    """Height of the observer in m at a distance from the runway's centre in km."""
    return 8 - 2.5 * (3.4 - distance)


def approach(distance: float, fov: float = 14.0, level: bool = False) -> str:
    """The scene seen from so many km."""
    height = elevation(distance)
    view = (
        f"FROM < {1000 * distance:.10g}, 0, {height:.10g} > TO < 0, 0, {height if level else 0:.10g} > FOV {fov:.10g} "
    )
    text, found = VIEW.subn(view, RUNWAY.read_text(encoding="utf-8"))
    assert found == 1, "the view of runway.m3d is not where it was"
    # On some of the stills the observer is exactly as high as a point of the profile, and that is meant.
    return f"/* m3d: allow M3D0506 */\n{text}"


def main() -> None:
    parser = argparse.ArgumentParser(description="Print the runway as seen by a pilot who comes in.")
    parser.add_argument("distance", type=float, help="from the runway's centre, km; 0.3 to 3.4")
    parser.add_argument("--fov", type=float, default=14.0, help="width of the view, degrees (14)")
    parser.add_argument("--level", action="store_true", help="look straight ahead, not down at the runway")
    options = parser.parse_args()
    if not 0.3 <= options.distance <= 3.4:
        parser.error("the path begins 3.4 km from the runway's centre and ends at 0.3 km")
    print(approach(options.distance, options.fov, options.level), end="")


if __name__ == "__main__":
    main()
