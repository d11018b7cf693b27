"""The cell as a picture: in 3-D, or as plan and elevation where the browser cannot draw that."""

from nicegui import ui

from depal.domain import CellLayout
from depal.server.cellstate import CellState
from depal.server.screen.markup import Markup, joined, tag
from depal.server.screen.pane import html, put
from depal.server.screen.panels.marks import SHAPES, TINTS, Mark
from depal.server.screen.plan import both
from depal.server.screen.scene import CellScene
from depal.server.screen.words import Words

SLOW = 0.5
"""Between two plans [s]."""

ABLE = """
(() => {
  const kept = localStorage.getItem('depal-view');
  if (kept) return kept;
  const canvas = document.createElement('canvas');
  const gl = canvas.getContext('webgl2', {failIfMajorPerformanceCaveat: true});
  if (!gl) return 'plan';
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  return /swiftshader|llvmpipe|software/i.test(name) ? 'plan' : 'scene';
})()
"""
"""Which picture a browser is shown: what was chosen on it, else what its hardware can do."""


class CellView:
    """Both pictures, one of them visible, and the switch between them."""

    def __init__(self, layout: CellLayout, words: Words) -> None:
        """The plan, until the browser has said what it can do."""
        self._layout, self._words = layout, words
        self._kind = "plan"
        self._scene: CellScene | None = None
        self._state: CellState | None = None
        self._drawn = 0.0
        with ui.element("section").classes("card cell"):
            with ui.element("div").classes("head"):
                html(words("view.title"), "h3")
                kinds = {"scene": words("view.scene"), "plan": words("view.flat")}
                self._switch = ui.toggle(kinds, value="plan", on_change=self._choose)
                self._switch.props("no-caps unelevated").mark("view")
            self._room = ui.element("div").classes("room")
            with self._room:
                self._plan = html("").classes("plan")
            html(legend(words)).classes("legend")

    async def settle(self) -> None:
        """Asks the browser what it can draw."""
        kind = await ui.run_javascript(ABLE, timeout=5)
        self._show_kind("scene" if kind == "scene" else "plan")

    def show(self, state: CellState, now: float) -> None:
        """As the state is; the plan at most every half second.

        Args:
            state: of the cell.
            now: of any steady clock [s].
        """
        self._state = state
        if self._kind == "scene" and self._scene is not None:
            self._scene.show(state)
        elif now - self._drawn >= SLOW:
            self._drawn = now
            put(self._plan, both(self._layout, state, self._words))

    def _show_kind(self, kind: str) -> None:
        self._kind = kind
        if self._switch.value != kind:
            self._switch.set_value(kind)
        self._plan.set_visibility(kind == "plan")
        if kind == "scene" and self._scene is None:
            with self._room:
                self._scene = CellScene(self._layout, self._words)
                self._scene.element.props(f'role=img aria-label="{self._words("view.scene_what")}"')
        if self._scene is not None:
            self._scene.element.set_visibility(kind == "scene")
        if self._state is not None:
            self._drawn = 0.0
            self.show(self._state, SLOW)

    def _choose(self) -> None:
        kind = self._switch.value
        if kind in {"scene", "plan"} and kind != self._kind:
            ui.run_javascript(f"localStorage.setItem('depal-view', '{kind}')")
            self._show_kind(kind)


def legend(words: Words) -> Markup:
    """What the marks mean."""
    items = (
        tag(
            "li",
            tag("span", SHAPES[mark], style=f"color:{TINTS[mark].line}", aria_hidden="true"),
            words(f"legend.{mark.value}"),
        )
        for mark in (Mark.TARGET, Mark.REQUESTED, Mark.BLOCKER, Mark.ASKED)
    )
    return tag("ul", joined(items))
