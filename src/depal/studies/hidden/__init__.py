"""Requests for boxes that nobody has seen: the paper waits, access searches."""

from depal.studies.hidden.looking import REGION, Looks, true_place
from depal.studies.hidden.runs import Hidden, by_access, by_paper, held_by_region
from depal.studies.hidden.trials import POLICIES, HiddenRow, draw_hidden, hidden_rows, hidden_trial

__all__ = [
    "POLICIES",
    "REGION",
    "Hidden",
    "HiddenRow",
    "Looks",
    "by_access",
    "by_paper",
    "draw_hidden",
    "held_by_region",
    "hidden_rows",
    "hidden_trial",
    "true_place",
]
