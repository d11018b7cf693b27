"""The first selection with a request: what the request does to the scores (Fig. 10)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.table import Table

from depal.app.pictures.files import save_picture
from depal.app.pictures.scores import Scored, score_picture
from depal.app.reports.report import plain_table
from depal.cell.reporting import ChoiceNote, Journalist
from depal.cell.workplace import Workplace
from depal.ports import Frame

PICTURE = "scores.png"


@dataclass(frozen=True, slots=True, eq=False)
class Scores:
    """One selection.

    Attributes:
        boxes: with their scores, best first.
        frame: the picture that it was made on; None where nothing takes pictures.
    """

    boxes: tuple[Scored, ...]
    frame: Frame | None

    @property
    def table(self) -> Table:
        """For people."""
        table = plain_table("Scores at the first selection", "box", "before", "after the request")
        for box in self.boxes:
            name = f"{box.name} (wanted)" if box.wanted else box.name
            table.row(name, f"{box.before:.3f}", f"{box.after:.3f}")
        return table

    def save(self, folder: Path) -> None:
        """Draws them over the picture."""
        if self.frame is not None:
            save_picture(folder / PICTURE, score_picture(self.frame, self.boxes))


class ScoreKeeper:
    """Keeps the first selection in which a request counts."""

    def __init__(self, work: Workplace, frames: Callable[[], Sequence[Frame]]) -> None:
        """Nothing was selected yet.

        Args:
            work: what the cell believes.
            frames: of the last look.
        """
        self._work, self._frames = work, frames
        self.scores: Scores | None = None

    def listen_to(self, notes: Journalist) -> None:
        """Learns of selections."""
        notes.listen(chosen=self._chosen)

    def _chosen(self, note: ChoiceNote) -> None:
        if self.scores is not None or not any(line.l > 0.0 for line in note.lines):
            return
        shapes = {box.id: box.shape for box in self._work.pile.boxes}
        asked = {wish.request.box for wish in self._work.wishes}
        weight = 1.0 - self._work.settings.w
        frames = self._frames()
        self.scores = Scores(
            tuple(
                Scored(str(line.box), shapes[line.box], weight * line.h, line.s, line.box in asked)
                for line in note.lines
                if line.box in shapes
            ),
            frames[0] if frames else None,
        )
