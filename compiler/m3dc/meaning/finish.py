"""What must hold of a whole block when its closing brace is reached, or when a variable is put to use.

One function a block, in `FINISH`; it reports what is wrong and makes what follows from all members together. `whole`
is False for a variable that is still being put together.
"""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from m3d_language.table import LANGUAGE

from ..diagnostics import Findings, catalogue
from .primitive import PRIMITIVES, Finish
from .values import Record


def _nothing(record: Record, findings: Findings, *, whole: bool) -> None:
    pass


def _solid(record: Record, findings: Findings, *, whole: bool) -> None:
    if whole and not record.parts and not record.broken:
        *others, last = (kind.name for kind in PRIMITIVES)
        findings.add_at(catalogue.NO_PRIMITIVES, record.span, f"give it a {', '.join(others)} or {last}")


def _direction(record: Record, findings: Findings, *, whole: bool) -> None:
    x, y, z = record.vector("DIRECTION")
    place = record.place("DIRECTION")
    if x == y == z == 0:
        if "FROM" in record.places or "TO" in record.places:
            findings.add_at(catalogue.FROM_EQUALS_TO, place, "they are the same point, and so give no direction")
        else:
            findings.add_at(catalogue.ZERO_DIRECTION, place, "a direction is a vector of any length but zero")
    elif record.block == "SUN" and z >= 0:
        findings.add_at(
            catalogue.SUN_BELOW_HORIZON, place, f"sunlight travels down; the z of its direction is {z:g}, expected < 0"
        )


def _view(record: Record, findings: Findings, *, whole: bool) -> None:
    eye, target = record.vector("FROM"), record.vector("TO")
    distance = max(abs(t - e) for e, t in zip(eye, target, strict=True))
    if distance <= 1e-12 * max(1.0, *(abs(e) for e in eye)):
        place = record.places.get("TO") or record.place("FROM")
        findings.add_at(catalogue.FROM_EQUALS_TO, place, "the point looked at must differ from the observer's position")
    region = record.values["REGION"]
    assert isinstance(region, tuple)
    top, left, bottom, right = region
    if bottom < top:
        findings.add_at(
            catalogue.REGION_BOTTOM_ABOVE_TOP, record.place("REGION"), f"bottom {bottom:g} is set to top, {top:g}"
        )
    if right < left:
        findings.add_at(
            catalogue.REGION_RIGHT_BEFORE_LEFT, record.place("REGION"), f"right {right:g} is set to left, {left:g}"
        )
    record.values["REGION"] = (top, left, max(top, bottom), max(left, right))


def _mirage(record: Record, findings: Findings, *, whole: bool) -> None:
    profile = record.tables.get("PROFILE")
    if profile is None:
        if "PROFILE" not in record.broken:
            findings.add_at(
                catalogue.NO_PROFILE,
                record.span,
                "a MIRAGE needs its temperatures: PROFILE { elevation temperature ... }",
            )
        return
    elevation = profile.rows[:, 0]
    points, least, most = len(elevation), LANGUAGE.limits["profile_least"], LANGUAGE.limits["profile_most"]
    if points < least:
        findings.add_at(catalogue.TOO_FEW_PROFILE_POINTS, profile.span, f"found {points}")
    elif points > most:
        findings.add_at(
            catalogue.TOO_MANY, profile.place(most), f"found {points}, at most {most}", fill="PROFILE points"
        )
    falling = np.flatnonzero(np.diff(elevation) <= 0)
    if falling.size:
        row = int(falling[0]) + 1
        detail = f"{elevation[row]:g} comes after {elevation[row - 1]:g}; they go from low to high"
        findings.add_at(catalogue.PROFILE_NOT_INCREASING, profile.place(row), detail)
    if points < least or points > most or falling.size:
        record.broken |= {"PROFILE"}


def _texture(record: Record, findings: Findings, *, whole: bool) -> None:
    colors = record.tables.get("COLORS")
    if colors is None:
        return
    most = LANGUAGE.limits["color_ranges"]
    if len(colors.rows) > most:
        findings.add_at(
            catalogue.TOO_MANY, colors.place(most), f"found {len(colors.rows)}, at most {most}", fill="color ranges"
        )
    previous = 0.0
    for row, (start, end) in enumerate(colors.rows[:, :2].tolist()):
        if not previous <= start < end <= 1.0:
            detail = f"the range {start:g} to {end:g} must run upwards from {previous:g} or more to at most 1"
            findings.add_at(catalogue.COLOR_RANGES_NOT_INCREASING, colors.place(row), detail)
            return
        previous = end


def _scene(record: Record, findings: Findings, *, whole: bool) -> None:
    mirage = record.nested.get("MIRAGE")
    if mirage is None or "PROFILE" in mirage.broken or "PROFILE" not in mirage.tables:
        return
    view = record.member("VIEW")
    height = view.vector("FROM")[2]
    elevation = mirage.tables["PROFILE"].rows[:, 0]
    lowest, highest = float(elevation[0]), float(elevation[-1])
    place = view.place("FROM")
    detail = f"the observer is at {height:g}, the PROFILE runs from {lowest:g} to {highest:g}"
    if height < lowest:
        findings.add_at(catalogue.EYE_BELOW_PROFILE, place, detail)
    elif height > highest:
        findings.add_at(catalogue.EYE_ABOVE_PROFILE, place, detail)


FINISH: defaultdict[str, Finish] = defaultdict(
    lambda: _nothing,
    {
        "SCENE": _scene,
        "VIEW": _view,
        "MIRAGE": _mirage,
        "SUN": _direction,
        "SOURCE": _direction,
        "SOLID": _solid,
        **dict.fromkeys(LANGUAGE.blocks["TEXTURE"].holds, _texture),
        **{kind.name: primitive.finish for kind, primitive in PRIMITIVES.items()},
    },
)
