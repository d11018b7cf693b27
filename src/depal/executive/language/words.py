"""The words of the language: what begins a declaration, what begins a clause, what is no name."""

import difflib
from typing import Final

DECLARATIONS: Final = ("fact", "resource", "task", "action", "schema")

TASK_CLAUSES: Final = ("when", "until", "within", "limit", "avoids", "keeps")
ACTION_CLAUSES: Final = (
    *("when", "until", "within", "limit", "avoids", "uses", "sets"),
    *("cancel", "timeout", "retries", "backoff", "probe", "idempotent"),
)
STEP_CLAUSES: Final = ("when", "bias")
CLAUSES: Final = frozenset({*TASK_CLAUSES, *ACTION_CLAUSES, *STEP_CLAUSES})

CONNECTIVES: Final = ("and", "or", "for")
KEYWORDS: Final = frozenset(
    {*DECLARATIONS, *CLAUSES, *CONNECTIVES, "capacity", "not", "true", "false"}
)
"""Words that cannot be names."""

AND: Final = frozenset({"and", "∧", "^", "&", "&&"})
OR: Final = frozenset({"or", "\N{LOGICAL OR}", "v", "|", "||"})
NOT: Final = frozenset({"not", "¬", "~", "!"})
OPEN_LIST: Final = frozenset({"<", "⟨"})
CLOSE_LIST: Final = frozenset({">", "⟩"})
COMPARISON_GLYPHS: Final = {"≠": "!=", "≤": "<=", "≥": ">="}

ALIKE: Final = 0.75
"""How much alike a slip and its word are, where one is all and nought is nothing."""

SECONDS: Final = {"ms": 0.001, "s": 1.0, "min": 60.0}
"""Units of a duration [s]."""


def meant(word: str, known: tuple[str, ...]) -> str:
    """What may have been meant by a word; empty where nothing is close.

    Capitals and swapped letters are forgiven.
    """
    if word in known:
        return ""
    for right in known:
        if sorted(word.lower()) == sorted(right):
            return f"did you mean {right!r}?"
    close = difflib.get_close_matches(word.lower(), known, n=1, cutoff=ALIKE)
    return f"did you mean {close[0]!r}?" if close else ""


def listed(words: tuple[str, ...], last: str = "or") -> str:
    """Words as a sentence lists them: `a, b or c`."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} {last} {words[-1]}"
