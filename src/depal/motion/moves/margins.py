"""How far things stay apart in each part of a motion, and how long the straight parts are."""

import math

from depal.motion.collision import Margins

CLOSE = Margins(arm=0.02, tool=0.004, held=0.004, pile=-0.012, floor=0.01)
"""Near boxes, in straight parts: the held box may rub along cases, by the errors of its pose."""

DEEPER = 0.003
"""A careful way out takes a box no deeper into its neighbours than it seems to be already [m]."""

ENTRY = Margins(arm=0.02, tool=0.005, held=0.004, pile=0.004, floor=0.01)
"""Going into a place: narrow, but clear."""

LEAVING = ENTRY._replace(tool=0.002)
"""Out of a place again, away from the box that was set down."""

OPEN = Margins(arm=0.03, tool=0.015, held=0.015, pile=0.015, floor=0.02)
"""In free space."""

RESTING = Margins(*(margin + 0.003 for margin in OPEN))
"""Where the arm comes to rest the next motion begins, and a servo is off by a little."""

TILT = math.radians(25)
"""So far may a held box lean in free space [rad]."""

BEFORE = 0.10
"""A straight approach begins this far before the plane of touch [m]."""

AFTER = 0.05
"""The straight ways into a place and out of it are at least this long [m]."""

LIFT = 0.008
"""A box is lifted by this before it is pulled out [m]."""

BEYOND = 0.05
"""A way out of the pile is at least this long: a held box hangs lower than it stood [m]."""

FURTHEST = 0.9
"""No straight move out is longer [m]."""

BELOW = 0.012
"""A descent goes on for this below where the box should stand: the load stops it [m]."""

FINE = 0.004
"""Distance between two configurations of a lift or a descent [m]."""
