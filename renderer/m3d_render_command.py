"""Where the commands of this distribution start, before NumPy and the kernel are loaded: `m3dc_command` says how."""

from __future__ import annotations

from collections.abc import Callable

from m3dc_command import started


def m3d_render() -> int:
    """Run `m3d-render`; returns its exit status."""

    def load() -> Callable[[], int]:
        from m3d_render.cli import main

        return main

    return started("m3d-render", load)


def m3d_rays() -> int:
    """Run `m3d-rays`; returns its exit status."""

    def load() -> Callable[[], int]:
        from m3d_render.rays_cli import main

        return main

    return started("m3d-rays", load)


def m3d_plot() -> int:
    """Run `m3d-plot`; returns its exit status."""

    def load() -> Callable[[], int]:
        from m3d_render.plot.cli import main

        return main

    return started("m3d-plot", load)


def m3d_view() -> int:
    """Run `m3d-view`; returns its exit status."""

    def load() -> Callable[[], int]:
        from m3d_render.view.cli import main

        return main

    return started("m3d-view", load)
