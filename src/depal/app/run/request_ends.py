"""I8: every accepted request has ended, exactly once, and as it truly should."""

from collections.abc import Iterator, Mapping, Sequence

from depal.cell.wishes import Wish
from depal.domain import BoxId
from depal.logistics.store import KeptRequest, RequestState
from depal.simulation.referee import Referee


def wrong_ends(
    kept: Sequence[KeptRequest],
    wishes: Mapping[str, Wish],
    stack: Mapping[BoxId, int],
    referee: Referee,
) -> Iterator[str]:
    """What is wrong with how the requests have ended, in words.

    Args:
        kept: the requests in the store's data after the run.
        wishes: what the cell has made of each, by the key in the store's data.
        stack: which box of the stack each name means.
        referee: knows what each box is.
    """
    for each in kept:
        wish, name = wishes.get(each.key), f"request {each.key} for {each.request.wanted}"
        if each.state is RequestState.PENDING:
            yield f"I8: {name} has not ended"
        if wish is None:
            yield f"I8: {name} is not known to the cell"
            continue
        if (each.state is RequestState.SERVED) != (wish.served is not None):
            yield f"I8: {name} has ended {each.state.value}, the cell says otherwise"
        index = stack.get(wish.box) if wish.box is not None else None
        wanted = each.request.gtin
        if index is not None and wanted is not None and referee.product(index) != wanted:
            yield f"I8: {name} was served by box {wish.box}, which is {referee.product(index)}"
    served = [wish.box for wish in wishes.values() if wish.box is not None]
    for box in sorted({box for box in served if served.count(box) > 1}):
        yield f"I8: box {box} has served {served.count(box)} requests"
