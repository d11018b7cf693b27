"""What a held box keeps clear of on its way out of a pile that nobody knows exactly."""

from depal.cell.breadth import room_beside
from depal.cell.planning.plans import Load
from depal.cell.planning.promises import Promises
from depal.cell.workplace import Workplace
from depal.domain import Perceived, Recognition
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
    pile, zones = work.pile, load.rules.zones
    near = promises.scene(pile, load.box, zones)
    others = [box for box in pile.boxes if box.id != load.box]
    if not pile.remembered or all(isinstance(box, Recognition) for box in others):
        return (near,)

    def shape_of(box: Perceived) -> OrientedBox:
        return room_beside(box, work.delivery, unsized=box.id in pile.unsized)

    return promises.scene(pile, load.box, zones, shape_of), near
