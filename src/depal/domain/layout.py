"""The cell as its file describes it: everything that stands in it, and where."""

from dataclasses import dataclass
from enum import Enum

from depal.domain.names import PlaceId
from depal.domain.place import Place
from depal.domain.robot import Robot
from depal.domain.tool import Tool
from depal.geometry import OrientedBox, Pose, Vector3


class StorageKind(Enum):
    """What a storage is."""

    TROLLEY = "trolley"
    SHELF = "shelf"


@dataclass(frozen=True, slots=True)
class Storage:
    """A trolley in its bay, or a fixed shelf.

    Attributes:
        id: its name; a trolley's is its bay's, for another trolley may stand there later.
        kind: trolleys can be exchanged.
        cell_from_storage: the middle of the front's lower edge, on the floor; x to the back,
            y to the left as seen by somebody who looks into it, z up.
        size: width (y), depth (x), height (z) over all [m].
        panels: its solid parts, in the storage's frame.
        places: its compartments, from the lowest up.
    """

    id: str
    kind: StorageKind
    cell_from_storage: Pose
    size: Vector3
    panels: tuple[OrientedBox, ...]
    places: tuple[Place, ...]


@dataclass(frozen=True, slots=True)
class PalletStand:
    """Where pallets come to stand.

    Attributes:
        cell_from_pallet: the pallet's frame: x along its length, y along its width, z up from the
            deck, origin in a corner of the deck.
        size: length, width, deck height of the pallets that fit [m].
    """

    cell_from_pallet: Pose
    size: Vector3


@dataclass(frozen=True, slots=True)
class CameraMount:
    """A camera.

    Attributes:
        name: of this camera.
        cell_from_camera: its pose: z forward along the view, x right, y down in the picture.
        colour_size: width and height of the colour picture [pixel].
        depth_size: width and height of the depth picture [pixel].
        vertical_view: angle of view from the top to the bottom of the picture [rad].
    """

    name: str
    cell_from_camera: Pose
    colour_size: tuple[int, int]
    depth_size: tuple[int, int]
    vertical_view: float


@dataclass(frozen=True, slots=True)
class ReaderMount:
    """The barcode reader.

    Attributes:
        cell_from_reader: its pose: z forward along its line of sight, x right, y down.
        distance: from the lens to where a label is to be shown [m].
        field: width and height of what it sees at that distance [m].
        pixels: width and height of its picture.
    """

    cell_from_reader: Pose
    distance: float
    field: tuple[float, float]
    pixels: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Fiducial:
    """A square marker that is fixed to the cell, for cameras to find their pose by.

    Attributes:
        id: which pattern it shows (ArUco, 4 x 4 bits, the first 50).
        size: edge of its black square [m]; a white rim of a sixth of it lies around.
        cell_from_marker: its middle: x right and y down as one looks at it, z into its plate.
    """

    id: int
    size: float
    cell_from_marker: Pose


@dataclass(frozen=True, slots=True)
class SpeedLimits:
    """How fast the arm may be, beside its axes' own limits.

    Attributes:
        flange: speed of the flange in free space [m/s].
        straight: speed in straight moves near boxes [m/s].
        set_down: speed of the last part of setting a box down [m/s].
        near: speed of flange and tool while somebody is near [m/s].
    """

    flange: float
    straight: float
    set_down: float
    near: float = 0.25


@dataclass(frozen=True, slots=True)
class Zone:
    """A volume that tasks may keep out of.

    Attributes:
        name: by which task files call it.
        solid: its volume, in the cell frame.
    """

    name: str
    solid: OrientedBox


@dataclass(frozen=True, slots=True)
class CellLayout:
    """A cell. The frame: robot's base at the origin, x to the pallet, y to the left, z up.

    Attributes:
        name: of the cell.
        floor: the corners of the floor with the smallest and greatest x, y [m]; the fence stands
            on its edge, and no part of the arm or a held box may leave it (the safety zone).
        robot: the arm.
        tool: on its flange.
        pallet: where pallets stand.
        storages: trolleys and shelves.
        aside: the storage that boxes are set aside into.
        cameras: at least one faces the pallet.
        reader: a held box can be shown to it.
        speeds: limits for the arm.
        fixtures: further solid things (masts, the reader's housing), in the cell frame.
        fiducials: markers on the floor and on fixtures, each pattern once.
        zones: volumes that arm, tool and held box keep out of while a task says so.
    """

    name: str
    floor: tuple[tuple[float, float], tuple[float, float]]
    robot: Robot
    tool: Tool
    pallet: PalletStand
    storages: tuple[Storage, ...]
    aside: str
    cameras: tuple[CameraMount, ...]
    reader: ReaderMount
    speeds: SpeedLimits
    fixtures: tuple[OrientedBox, ...] = ()
    fiducials: tuple[Fiducial, ...] = ()
    zones: tuple[Zone, ...] = ()

    @property
    def places(self) -> dict[PlaceId, Place]:
        """Every compartment by its name."""
        return {place.id: place for storage in self.storages for place in storage.places}

    def storage(self, name: str) -> Storage:
        """The storage of that name, or that a place of that name belongs to."""
        owner = name.split("/", maxsplit=1)[0]
        return next(storage for storage in self.storages if storage.id == owner)
