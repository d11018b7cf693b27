"""Which box of a look is which that stands there: by their faces."""

from collections.abc import Sequence

from depal.perception.faces import Face, Look
from depal.studies.perception.matching import Matching
from depal.studies.perception.truth import Truth


def all_faces(look: Look) -> tuple[Face, ...]:
    """Every face of a look, once: those that were detected, and any that only a box has."""
    return tuple(dict.fromkeys((*look.faces, *(f for box in look.boxes for f in box.faces))))


def match_boxes(
    look: Look, truth: Truth, faces: Sequence[Face], matching: Matching
) -> tuple[dict[int, int], dict[int, int]]:
    """Seen boxes with the true ones that they are, one to one; and those that are one once more.

    A box is the one that its largest matched face belongs to; where two seen boxes are the same
    true one, the one with more of it is, and the other is it once more.

    Args:
        look: what was seen.
        truth: what is there.
        faces: of the look, as they were matched.
        matching: of these faces.
    """
    owner = {
        faces[found]: truth.faces[true].box for found, true in (*matching.pairs, *matching.ignored)
    }
    claims: list[tuple[float, int, int]] = []
    for index, box in enumerate(look.boxes):
        shares: dict[int, float] = {}
        for face in box.faces:
            if face in owner:
                area = face.size[0] * face.size[1]
                shares[owner[face]] = shares.get(owner[face], 0.0) + area
        if shares:
            best = max(shares, key=lambda true: (shares[true], -true))
            claims.append((shares[best], index, best))
    matched: dict[int, int] = {}
    again: dict[int, int] = {}
    for _, index, best in sorted(claims, key=lambda claim: (-claim[0], claim[1])):
        chosen = again if best in matched.values() else matched
        chosen[index] = best
    return matched, again
