"""The paper's figures, drawn from plain numbers.

Each function takes arrays and small values and returns a matplotlib figure; nothing is shown,
nothing global is touched. `save_figure` puts it into a file.
"""

from depal.studies.drawing.blocking import blocking_graph
from depal.studies.drawing.front import SeenBox
from depal.studies.drawing.piles import PileState, Stack, three_piles
from depal.studies.drawing.priority import grid_centres, priority_field
from depal.studies.drawing.reduction import Reduction, reduction_over_weight
from depal.studies.drawing.save import save_figure
from depal.studies.drawing.scores import ScoredLayout, scored_front
from depal.studies.drawing.stability import Agreed, Along, stability_figure
from depal.studies.drawing.table import TableRow, table_figure
from depal.studies.drawing.throughput import Emptied, throughput_figure

__all__ = [
    "Agreed",
    "Along",
    "Emptied",
    "PileState",
    "Reduction",
    "ScoredLayout",
    "SeenBox",
    "Stack",
    "TableRow",
    "blocking_graph",
    "grid_centres",
    "priority_field",
    "reduction_over_weight",
    "save_figure",
    "scored_front",
    "stability_figure",
    "table_figure",
    "three_piles",
    "throughput_figure",
]
