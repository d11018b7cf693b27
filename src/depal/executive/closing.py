"""Why a running primitive has lost its gate, in words for the journal."""

from depal.executive.nodes import LiveNode


def closed_by(node: LiveNode) -> str:
    """Why a node that ran may not run any more.

    Args:
        node: its gate is closed.

    Returns:
        A phrase; it names the task whose `within` does not hold where nothing else is in the way.
    """
    if not node.kept:
        return "no longer enabled"
    here, above = node, node.parent
    while above is not None and not above.gate:
        here, above = above, above.parent
    return f"what {here.node.label} has to stay within does not hold"
