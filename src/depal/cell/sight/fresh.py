"""A sight that is not believed when it shows what was before (P1 of RELIABILITY)."""

from dataclasses import dataclass

from depal.errors import DeviceError
from depal.ports import Clock, Sight, View


@dataclass(frozen=True, slots=True)
class FreshSight:
    """Nothing is done on a scene that nobody has seen since the look began.

    Attributes:
        sight: that looks.
        clock: tells how old a view is.
    """

    sight: Sight
    clock: Clock

    async def look(self) -> View:
        """Looks.

        Raises:
            DeviceError: no picture came, or one that was taken before.
        """
        began = self.clock.now()
        view = await self.sight.look()
        if view.taken < began:
            raise DeviceError(
                f"the camera is frozen: its picture is {began - view.taken:.1f} s old"
            )
        return view
