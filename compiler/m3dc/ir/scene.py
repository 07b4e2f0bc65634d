"""A compiled scene: what is said once, and the tables."""

from __future__ import annotations

from collections.abc import Mapping

from .tables import Columns, Globals


class SceneIR:
    """A compiled scene. `tables` has every table and column of TABLES; `source` is the scene file's name."""

    __slots__ = ("scene", "source", "tables")

    def __init__(self, scene: Globals, tables: Mapping[str, Columns], source: str = "") -> None:
        self.scene = scene
        self.tables = tables
        self.source = source

    def __getitem__(self, table: str) -> Columns:
        return self.tables[table]

    def _repr_html_(self) -> str:
        from .html import scene_html  # here, because only notebooks ask

        return scene_html(self.scene, self.tables, self.source)


def with_square_pixels(ir: SceneIR) -> SceneIR:
    """The scene as it is seen where pixels are as tall as wide: its ASPECT is undone. The tables are the same ones."""
    view = ir.scene.view
    if view.aspect == 1:
        return ir
    return SceneIR(ir.scene._replace(view=view._replace(aspect=1.0)), ir.tables, ir.source)
