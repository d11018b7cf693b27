"""What the cell says, put into the screen's language where its sentences are known."""

import re
from collections.abc import Callable, Sequence
from typing import Final

Said = Callable[[str], str]

Pattern = tuple[re.Pattern[str], str]


def _known(*pairs: tuple[str, str]) -> tuple[Pattern, ...]:
    """Sentences with names in braces, which stay as they are."""
    found = []
    for sentence, other in pairs:
        parts = re.split(r"\{(\w+)\}", sentence)
        body = "".join(
            f"(?P<{part}>.+?)" if place % 2 else re.escape(part) for place, part in enumerate(parts)
        )
        found.append((re.compile(body), other))
    return tuple(found)


ITALIAN_SENTENCES: Final[tuple[Pattern, ...]] = _known()


def said_in(language: str) -> Said:
    """What puts the cell's sentences into a language; what it does not know stays English."""
    known: Sequence[Pattern] = {"it": ITALIAN_SENTENCES}.get(language, ())

    def say(sentence: str) -> str:
        for pattern, other in known:
            found = pattern.fullmatch(sentence)
            if found is not None:
                return other.format(**found.groupdict())
        return sentence

    return say
