"""Pictures of a run."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from depal.app.pictures import CellPainter, save_animation, save_picture
from depal.app.pictures.captions import caption_height, captioned
from depal.app.pictures.painter import viewpoint
from depal.cell.files import shipped_cell
from depal.logistics import shipped_deliveries
from depal.simulation.cases import cases_of
from depal.simulation.world import World

LAYOUT = shipped_cell("default")
DELIVERY = shipped_deliveries()[1]
SIZE = (320, 240)


@pytest.fixture(scope="module")
def world() -> World:
    """A delivery on its pallet; nothing is moved."""
    return World(LAYOUT, cases_of(DELIVERY, DELIVERY.stack or (), LAYOUT))


@pytest.fixture(scope="module")
def painter(world: World) -> CellPainter:
    """Of this cell."""
    return CellPainter(LAYOUT, world.cases)


def changed(first: np.ndarray, second: np.ndarray) -> int:
    """How many pixels differ clearly."""
    apart = np.abs(first.astype(int) - second.astype(int)).max(axis=2)
    return int(np.count_nonzero(apart > 12))


def test_the_whole_cell_is_in_the_picture_whatever_its_shape() -> None:
    """Every corner of the floor and of every storage."""
    for size in ((800, 600), (600, 800), (1200, 300)):
        lens = viewpoint(LAYOUT, size)
        seen = lens.cell_from_camera.inverse
        (x0, y0), (x1, y1) = LAYOUT.floor
        points = [(x, y, 0.0) for x in (x0, x1) for y in (y0, y1)]
        points += [
            storage.cell_from_storage.apply((0.0, side, storage.size[2]))
            for storage in LAYOUT.storages
            for side in (-storage.size[0] / 2, storage.size[0] / 2)
        ]
        for point in points:
            x, y, z = seen.apply(point)
            column = lens.focal[0] * x / z + lens.centre[0]
            row = lens.focal[1] * y / z + lens.centre[1]
            assert 0 <= column < size[0]
            assert 0 <= row < size[1]


def test_a_picture_is_as_large_as_asked_and_the_same_every_time(
    world: World, painter: CellPainter
) -> None:
    """With and without a caption."""
    for caption in ("", "one line", "two\nlines"):
        first, again = (painter.picture(world.snapshot(), caption, SIZE) for _ in range(2))
        assert first.shape == (240, 320, 3)
        assert first.tobytes() == again.tobytes()


def test_what_is_taken_away_is_gone_from_the_picture(world: World, painter: CellPainter) -> None:
    """A box that people removed, and a trolley that was pushed out of its bay."""
    before = painter.picture(world.snapshot(), "", SIZE)
    snapshot = world.snapshot()
    snapshot.bays["trolley_4"] = None
    assert changed(before, painter.picture(snapshot, "", SIZE)) > 500
    top = int(np.argmax(snapshot.boxes[:, 2]))
    world.removed.append(top)
    without = painter.picture(world.snapshot(), "", SIZE)
    world.removed.clear()
    assert changed(before, without) > 20


def test_what_stands_in_a_near_trolley_is_seen_through_its_back(
    world: World, painter: CellPainter
) -> None:
    """A box in trolley_2, whose back is turned to the viewer."""
    snapshot = world.snapshot()
    before = painter.picture(snapshot, "", SIZE)
    x, y, z = LAYOUT.places["trolley_2/level_2"].cell_from_place.translation
    snapshot.boxes[0, :3] = (x, y + 0.3, z + 0.12)
    shown = painter.picture(snapshot, "", SIZE)
    snapshot.boxes[0, :3] = (0.0, 0.0, -9.0)
    assert changed(shown, painter.picture(snapshot, "", SIZE)) > 50
    assert changed(shown, before) > 50


def test_a_caption_stands_below_and_is_cut_where_it_is_too_long() -> None:
    """The picture above it keeps every pixel."""
    picture = np.full((200, 320, 3), 77, dtype=np.uint8)
    bar = caption_height((320, 240), "first\nsecond")
    whole = captioned(picture, "first\n" + "very long " * 30, bar)
    assert whole.shape == (200 + bar, 320, 3)
    assert np.all(whole[:200] == 77)
    dark = np.nonzero((whole[201:] < 160).all(axis=2))[1]
    assert dark.min() > 4
    assert dark.max() < 316


def test_pictures_and_animations_are_written_as_files(
    tmp_path: Path, world: World, painter: CellPainter
) -> None:
    """A PNG with the pixels as they are, a GIF with a picture for every moment."""
    picture = painter.picture(world.snapshot(), "end", SIZE)
    save_picture(tmp_path / "end.png", picture)
    with Image.open(tmp_path / "end.png") as image:
        assert np.asarray(image).tobytes() == picture.tobytes()
    moments = [(world.snapshot(), f"moment {number}") for number in range(3)]
    save_animation(tmp_path / "run.gif", painter, moments, 5.0, SIZE)
    with Image.open(tmp_path / "run.gif") as image:
        assert image.size == SIZE
        assert image.n_frames == 3
        assert image.info["duration"] == 200
        assert image.info["loop"] == 0


def test_an_animation_of_nothing_is_refused(tmp_path: Path, painter: CellPainter) -> None:
    """No file without a moment."""
    with pytest.raises(ValueError, match="at least one moment"):
        save_animation(tmp_path / "run.gif", painter, [])
    assert not list(tmp_path.iterdir())
