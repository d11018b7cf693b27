"""What the cell says, put into the screen's language where its sentences are known."""

import re
from collections.abc import Callable
from typing import Final

from depal.server.screen.words.cell_italian import CELL_ITALIAN

Said = Callable[[str], str]

Pattern = tuple[re.Pattern[str], str]

NUMBERED: Final = re.compile(r"(?<=[a-z])_(?=[0-9])")
"""As in trolley_2, which people read as two words."""


LINK: Final = "; "
"""Between reasons, of which each is a sentence."""


def _known(pairs: tuple[tuple[str, str], ...]) -> tuple[Pattern, ...]:
    """Sentences with gaps in braces; what fills them is said in its turn."""
    found = []
    for sentence, other in pairs:
        parts = re.split(r"\{(\w+)\}", sentence)
        body = "".join(
            f"(?P<{part}>.+?)" if place % 2 else re.escape(part) for place, part in enumerate(parts)
        )
        found.append((re.compile(body), other))
    return tuple(found)


ITALIAN_SENTENCES: Final[tuple[Pattern, ...]] = _known(CELL_ITALIAN)


def said_in(language: str) -> Said:
    """What puts the cell's sentences into a language; what it does not know stays English."""
    known = {"it": ITALIAN_SENTENCES}.get(language, ())

    def say(sentence: str) -> str:
        for pattern, other in known:
            found = pattern.fullmatch(sentence)
            if found is not None:
                gaps = {name: say(gap) for name, gap in found.groupdict().items()}
                return NUMBERED.sub(" ", other.format(**gaps))
        if known and LINK in sentence:
            return LINK.join(say(part) for part in sentence.split(LINK))
        return NUMBERED.sub(" ", sentence)

    return say


def label_of(choice: str, said: Said) -> str:
    """An answer as it stands on a button."""
    told = said(choice)
    return f"{told[:1].upper()}{told[1:]}"
