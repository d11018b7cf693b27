"""Which product a box is, by what all its faces say together."""

from collections.abc import Sequence

from depal.domain import Gtin
from depal.perception.faces import Name
from depal.perception.recognition.trust import shipped_trust

DOUBTS = 0.3
"""What a face says against a name counts so much: tape and shadow make a face doubtful too."""


def believed(names: Sequence[Name]) -> Gtin | None:
    """The product that the faces of one box say.

    A face whose name is certain is enough, where no other face speaks against it more than that
    one is sure of. Faces that say the same, each not surely enough, are sure together when their
    odds together are and when no rival is one of every face's.

    Args:
        names: of a box's faces.
    """
    certain = {name.gtin for name in names if name.certain}
    if len(certain) > 1 or not names:
        return None
    gtin = next(iter(certain)) if certain else max(names, key=lambda name: name.odds).gtin
    same = [name for name in names if name.gtin == gtin]
    odds = sum(name.odds if name.odds > 0.0 else DOUBTS * name.odds for name in same)
    limit = shipped_trust().limit
    if certain:
        surest = max(name.odds for name in same if name.certain)
        return gtin if odds >= min(surest, limit) else None
    rivals = set.intersection(*({*name.rivals} for name in same))
    return gtin if len(same) > 1 and odds >= limit and not rivals else None
