"""What a held box keeps clear of on its way out of a pile that nobody knows exactly."""

from collections.abc import Set as AbstractSet

from depal.cell.breadth import room_beside
from depal.cell.laden import raised
from depal.cell.planning.plans import Load
from depal.cell.planning.promises import Promises
from depal.cell.straddling import STACKED, goes_on_beside
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Perceived, Recognition
from depal.geometry import OrientedBox
from depal.motion.collision import Scene


def scenes_around(load: Load, work: Workplace, promises: Promises) -> tuple[Scene, ...]:
    """All around a box in the hand, and what it is kept out of; as a motion tries them.

    Args:
        load: the box.
        work: of an exact sight boxes are as they look.
        promises: the books.

    Returns:
        First with the room that boxes without a name may take, then as they look: where that
        leaves no way, the box goes near to them.
    """
    near = promises.scene(work.pile, load.box, load.rules.zones)
    roomy = with_room(load.box, load.rules.zones, work, promises)
    return (near,) if roomy is None else (roomy, near)


def with_room(
    held: BoxId, zones: AbstractSet[str], work: Workplace, promises: Promises
) -> Scene | None:
    """All around a box in the hand with the room that boxes without a name may take.

    One of which the surface goes on beside it ends nobody knows where: on its other side, too.

    Args:
        held: the box.
        zones: that are avoided.
        work: of an exact sight boxes are as they look.
        promises: the books.

    Returns:
        None where boxes take no more room than they seem to.
    """
    pile = work.pile
    others = [box for box in pile.boxes if box.id != held]
    if not pile.remembered or all(isinstance(box, Recognition) for box in others):
        return None

    strange = pile.strange

    def shape_of(box: Perceived) -> OrientedBox:
        if isinstance(box, Recognition):
            return box.shape
        beside = goes_on_beside(box.shape, strange, above=STACKED)
        unsized = box.id in pile.unsized
        room = room_beside(box, work.delivery, unsized=unsized, beside=beside)
        return raised(room, box.shape, strange)

    return promises.scene(pile, held, zones, shape_of)
