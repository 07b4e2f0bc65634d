"""A stage in a window: its keys, clicks, and the file that it follows."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any, NamedTuple

from m3d_render.view.follower import Follower
from m3d_render.view.opening import Fault
from m3d_render.view.stage import Stage
from m3dc.files.interrupt import Interrupt

_POLL = 250  # milliseconds between two looks at the file
_CLICK = 4  # pixels by which the mouse may move in a click
MOUSE = ("click: what it is", "drag: turn; with shift: move; wheel: nearer, farther")


class Key(NamedTuple):
    """A key: its names in X11 and VTK, how it is written on the screen, what it does in words and in deed."""

    symbols: tuple[str, ...]
    shown: str
    says: str
    action: Callable[[], object]


def heading(name: str, stage: Stage) -> str:
    """What stands above a scene of this name."""
    vertical = "" if stage.vertical == 1 else f", heights × {stage.vertical:g}"
    return "\n".join([name + vertical, *stage.notes])


class Window:
    """A stage that listens to keys and clicks, and shows what its file becomes: with errors in it, the last scene that
    had none."""

    def __init__(self, stage: Stage, name: str, follower: Follower | None = None) -> None:
        self.stage = stage
        self._name = name
        self._follower = follower
        self._fault = ""
        self._help = True
        self._pressed_at = (0, 0)
        self._keys = (
            Key(("1",), "1", "from the scene's camera", lambda: stage.look("camera")),
            Key(("2",), "2", "from above", lambda: stage.look("above")),
            Key(("3",), "3", "from the side", lambda: stage.look("side")),
            Key(("r",), "r", "rays", lambda: stage.toggle("rays")),
            Key(("c",), "c", "camera and frustum", lambda: stage.toggle("camera")),
            Key(("l",), "l", "lights", lambda: stage.toggle("lights")),
            Key(("b",), "b", "box of the extents", lambda: stage.toggle("extents")),
            Key(("g",), "g", "ground and planes", lambda: stage.toggle("ground")),
            Key(("a",), "a", "axes", lambda: stage.toggle("axes")),
            Key(("w",), "w", "wireframe", stage.toggle_wires),
            Key(("plus", "equal", "KP_Add"), "+", "heights doubled", lambda: stage.stretch(2 * stage.vertical)),
            Key(("minus", "KP_Subtract"), "-", "heights halved", lambda: stage.stretch(stage.vertical / 2)),
            Key(("h",), "h", "this list", self._toggle_help),
            Key(("q", "Escape"), "q", "close", self.close),
        )
        self._refresh()

    def press(self, symbol: str) -> None:
        """Does what a key does; a key without a meaning does nothing."""
        for key in self._keys:
            if symbol in key.symbols:
                key.action()
        self._refresh()

    def click(self, column: int, row: int) -> str:
        """Says what is seen at a pixel, counted from the top left, in the picture and as text."""
        picked = self.stage.pick(column, row)
        text = "" if picked is None else self.stage.describe(picked)
        self.stage.say(text, "upper_right")
        return text

    def tick(self) -> bool:
        """Looks at the file; returns whether something else is shown since."""
        found = self._follower.poll() if self._follower is not None else None
        if found is None:
            return False
        if isinstance(found, Fault):
            print(found.report, end="", file=sys.stderr, flush=True)
            self._fault = f"{found.summary}\nshown is the last good scene"
        else:
            self._fault = ""
            self.stage.show(found)
            self.stage.say("", "upper_right")
        self._refresh()
        return True

    def _toggle_help(self) -> None:
        self._help = not self._help

    def close(self) -> None:
        """Ends `run`."""
        iren = self.stage.plotter.iren
        if iren is not None:
            iren.terminate_app()

    def run(self) -> int:
        """Shows the window until it is closed. Returns the signal that closed it (Ctrl-C in the terminal), or 0."""
        plotter: Any = self.stage.plotter
        iren = plotter.iren
        iren.enable_terrain_style(mouse_wheel_zooms=True, shift_pans=True)
        iren.clear_key_event_callbacks()
        # What observes the style's own event replaces the keys that VTK gives a meaning.
        iren.style.AddObserver("CharEvent", self._on_key)
        iren.add_observer("LeftButtonPressEvent", self._on_press)
        iren.add_observer("LeftButtonReleaseEvent", self._on_release)
        iren.add_observer("TimerEvent", self._on_timer)
        interrupt = Interrupt(self.close)
        try:
            with interrupt:
                iren.initialize()
                iren.create_timer(_POLL, repeating=True)
                plotter.show(auto_close=False)
        finally:
            plotter.close()
        return interrupt.number

    def _on_key(self, *_: object) -> None:
        self.press(self.stage.plotter.iren.interactor.GetKeySym())
        self.stage.plotter.render()

    def _on_press(self, *_: object) -> None:
        self._pressed_at = self.stage.plotter.iren.get_event_position()
        self.stage.upright()

    def _on_release(self, *_: object) -> None:
        column, upward = self.stage.plotter.iren.get_event_position()
        moved = max(abs(column - self._pressed_at[0]), abs(upward - self._pressed_at[1]))
        if moved <= _CLICK:
            self.click(column, self.stage.plotter.window_size[1] - 1 - upward)
            self.stage.plotter.render()

    def _on_timer(self, *_: object) -> None:
        if self.tick():
            self.stage.plotter.render()

    def _refresh(self) -> None:
        lines = heading(self._name, self.stage)
        self.stage.say(f"{lines}\n{self._fault}" if self._fault else lines, "upper_left", alarm=bool(self._fault))
        keys = "\n".join([*(f"{key.shown}  {key.says}" for key in self._keys), *MOUSE])
        self.stage.say(keys if self._help else "h  keys", "lower_left")
