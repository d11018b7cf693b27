"""A run as it goes, in the terminal: progress, the box and why, requests, rate."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from depal.cell.reporting import ChoiceNote, Journalist
from depal.cell.workplace import Workplace
from depal.executive import events as ev

LINES = 5
"""So many of the last things that happened are shown."""

REFRESH = 4
"""Times a second that the picture is drawn anew."""


class LiveView:
    """What a person who watches the run wants to see."""

    def __init__(self, work: Workplace, boxes: int) -> None:
        """A view of a run that is about to begin.

        Args:
            work: what the cell believes; read, never changed.
            boxes: how many the delivery has.
        """
        self._work = work
        self._boxes = boxes
        self._note: ChoiceNote | None = None
        self._doing: list[str] = []

    def listen_to(self, notes: Journalist) -> None:
        """Learns of what happens."""
        notes.listen(heard=self._heard, chosen=self._chosen)

    def _chosen(self, note: ChoiceNote) -> None:
        self._note = note

    def _heard(self, _: int, events: Sequence[ev.Event]) -> None:
        state = self._work.runtime.engine.state
        for event in events:
            if isinstance(event, ev.Started):
                label = state.trees[event.tree].nodes[event.node].node.label
                self._doing = [*self._doing[1 - LINES :], f"{event.at:7.1f} s  {label}"]

    def caption(self) -> str:
        """What is written below a picture of this moment: two lines."""
        left = self._work.departures.count
        note = self._note
        why = "looking at the pallet" if note is None else f"next: {note.target}: {note.why}"
        if left == self._boxes:
            why = "the pallet is empty"
        return f"{self._work.now:.0f} s, {left} of {self._boxes} boxes off the pallet\n{why}"

    def __rich__(self) -> RenderableType:
        """The picture of this moment."""
        return Group(self._progress(), self._why(), self._requests(), *map(Text, self._doing))

    def _progress(self) -> RenderableType:
        work = self._work
        left = work.departures.count
        now = work.now if left else 0.0
        rate = 3600 * left / now if now else 0.0
        grid = Table.grid(padding=(0, 2))
        grid.add_row(
            ProgressBar(total=self._boxes, completed=left, width=40),
            f"{left} of {self._boxes} boxes",
            f"{now:.0f} s simulated",
            f"{rate:.0f} boxes/h",
        )
        return grid

    def _why(self) -> RenderableType:
        note = self._note
        if note is None:
            return Text("looking at the pallet")
        name = note.target if note.target is not None else "no box"
        return Text.assemble(("next: ", "dim"), (str(name), "bold"), f"  {note.why}")

    def _requests(self) -> RenderableType:
        wishes = [wish for wish in self._work.wishes if wish.request.arrived <= self._work.now]
        if not wishes:
            return Text("no request", style="dim")
        said = [
            f"{wish.request.wanted} p = {wish.request.priority:g}: "
            + ("waits" if wish.served is None else f"served after {wish.boxes_before} boxes")
            for wish in wishes
        ]
        return Text("requests: " + "; ".join(said))


@contextmanager
def watched(view: LiveView) -> Iterator[None]:
    """Draws the view while a run goes, on the error stream; nothing where nobody watches."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield
        return
    with Live(view, console=console, refresh_per_second=REFRESH, transient=True):
        yield
