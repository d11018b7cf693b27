"""A world in another process, behind the ports of a cell."""

from depal.drivers.remote.finding import connect, start_world
from depal.drivers.remote.world import RemoteWorld

__all__ = ["RemoteWorld", "connect", "start_world"]
