"""The paper's own numbers, to stand beside ours. Source: Caccavale et al., RA-L 2020."""

from dataclasses import dataclass

WEIGHTS = (0.1, 0.3, 0.5, 0.7, 0.9)
"""The five weights of case study 1."""


@dataclass(frozen=True, slots=True)
class PaperRow:
    """One weight of Table I: mean and deviation of the actions before the requested case."""

    h_mean: float
    h_std: float
    hl_mean: float
    hl_std: float

    @property
    def reduction(self) -> float:
        """The actions saved on average: a point of Fig. 8."""
        return self.h_mean - self.hl_mean


TABLE_1 = {
    0.1: PaperRow(12.74, 9.91, 11.14, 9.89),
    0.3: PaperRow(13.10, 10.02, 9.18, 8.92),
    0.5: PaperRow(12.81, 9.19, 7.81, 7.34),
    0.7: PaperRow(13.03, 9.73, 7.69, 7.45),
    0.9: PaperRow(12.84, 9.47, 7.34, 7.13),
}
"""Table I, by weight; 50 pallets a weight."""

CASE_2_WEIGHT = 0.2
"""w of case study 2 (section III-C)."""

CASE_2_PRIORITY = 0.2
"""p(b1) of case study 2 (section III-C)."""

CASE_2_RANK_WITHOUT = 10
"""Which box b1 is in the sequence without the request (Fig. 10)."""

CASE_2_RANK_WITH = 8
"""Which box b1 is in the sequence with the request (Fig. 10)."""

FIG_9_STEPS = 20
"""After how many steps Fig. 9 shows the two piles."""

CASE_2_SPEED = 0.04
"""The share of the arm's speed in the experiment of case study 2 (section III-C)."""

CASE_2_SECONDS = 148.0
"""How long a box took in that experiment on average [s]."""

CASE_2_SECONDS_TO_REQUESTED = 1196.0
"""How long it took until b1 was stored in that experiment [s]."""
