"""`depal see` and `depal bench perception` from the command line."""

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from depal.domain import Gtin
from depal.geometry import OrientedBox, Pose
from depal.perception.faces import Face, Facing, Look, Name, SeenBox
from depal.perception.frames import RecordedFrame, write_frame_folder
from depal.ports import Frame
from depal.simulation.imaging.lens import aimed

Run = Callable[..., tuple[int, str, str]]

K = ((300.0, 0.0, 159.5), (0.0, 300.0, 119.5), (0.0, 0.0, 1.0))
GTIN = Gtin("12000823098180")


class Always:
    """A perception that always sees the same box."""

    def __init__(self, *told: object, **more: object) -> None:
        """Needs to be told nothing."""

    def look(self, frames: Sequence[Frame]) -> Look:
        """One named box."""
        del frames
        turn = ((0.0, -1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, -1.0))
        name = Name(GTIN, "top", 0.9, certain=True)
        face = Face(Facing.TOP, Pose((1.5, 0.0, 0.3), turn), (0.3, 0.2), 0.91, name=name)
        shape = OrientedBox.upright((1.5, 0.0, 0.2), (0.2, 0.3, 0.2))
        box = SeenBox(shape, 0.91, np.eye(6) * 1e-6, (face,), GTIN)
        return Look((box,), faces=(face,))


def frame() -> RecordedFrame:
    """A table with a box on it, from above, the box's top marked."""
    colour = np.full((240, 320, 3), 90, dtype=np.uint8)
    depth = np.full((240, 320), 2.0, dtype=np.float32)
    mask = np.zeros((240, 320), dtype=np.bool_)
    mask[102:138, 133:187] = True
    colour[mask], depth[mask] = 180, 1.7
    return RecordedFrame(
        colour, depth, K, K, aimed((1.5, 0.001, 2.0), (1.5, 0.0, 0.0)), None, (mask,)
    )


@pytest.fixture(name="folder")
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A frame, and a perception that knows what is in it."""
    monkeypatch.setattr("depal.app.see.looking.open_eye", Always)
    monkeypatch.setattr("depal.studies.perception.eye.open_eye", Always)
    write_frame_folder(tmp_path / "frame", frame())
    return tmp_path / "frame"


def test_what_is_seen_is_printed_as_json_and_told_beside_it(depal: Run, folder: Path) -> None:
    """The JSON alone is on the standard output."""
    status, out, err = depal("see", folder, "--note", "dev-035")
    assert status == 0
    fields = json.loads(out)
    assert (fields["frame"], fields["note"]) == (str(folder), "dev-035")
    assert fields["detections"][0]["gtin"] == GTIN
    assert fields["boxes"][0]["name"] == "b1"
    assert "One box seen by one camera" in err


def test_with_a_file_for_the_json_the_table_is_printed(
    depal: Run, folder: Path, tmp_path: Path
) -> None:
    """And the picture is drawn where it was asked for."""
    status, out, err = depal(
        "see", folder, "--json", tmp_path / "s.json", "--plot", tmp_path / "s.png"
    )
    assert (status, err) == (0, "")
    assert "One box seen by one camera" in out
    assert GTIN in out
    assert json.loads((tmp_path / "s.json").read_text())["boxes"]
    assert (tmp_path / "s.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("nowhere",), "nowhere: there is no such folder; expected a folder with frame.json in it"),
        (("simulated:dev-0",), "dev-0"),
        (("simulated:dev-000:0:wild",), "unknown severity 'wild'; there is: easy, hard, normal"),
        (("simulated:dev-000", "--book", "nowhere"), "holds no picture book"),
        (("simulated:dev-000", "--json", "no/s.json"), "there is no folder 'no'"),
        (("simulated:dev-000", "--plot", "s.gif"), "'s.gif' is no picture's name"),
    ],
)
def test_what_cannot_be_seen_is_one_error(
    depal: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, words: Sequence[str], message: str
) -> None:
    """And nothing is printed or written."""
    monkeypatch.chdir(tmp_path)
    status, out, err = depal("see", *words)
    assert (status, out) == (2, "")
    assert message in " ".join(err.split())
    assert not list(tmp_path.iterdir())


def test_a_black_frame_is_named(depal: Run, tmp_path: Path) -> None:
    """What, where, what was expected."""
    write_frame_folder(
        tmp_path / "black", replace(frame(), colour=np.zeros((240, 320, 3), np.uint8))
    )
    status, out, err = depal("see", tmp_path / "black")
    assert (status, out) == (2, "")
    words = " ".join(err.split())
    assert f"{tmp_path / 'black'}: black: 95 % of the colour picture is darker than 0" in words
    assert "expected" in words


def test_real_frames_are_measured_alone_with_no_scenes(
    depal: Run, folder: Path, tmp_path: Path
) -> None:
    """In every turn and light."""
    status, out, err = depal(
        "bench", "perception", "--scenes", 0, "--frames", folder, "--json", tmp_path / "b.json"
    )
    assert (status, err) == (0, "")
    assert "real frames" in out
    fields = json.loads((tmp_path / "b.json").read_text())
    names = [figure["name"] for figure in fields["figures"]]
    assert names[0] == "frame: found of 1"
    assert len(fields["frames"]) == 15
    assert fields["rows"] == fields["times"] == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--severity", "wild"), "--severity: unknown severity 'wild'; there is: all, easy, hard"),
        (("--frames", "nowhere"), "nowhere: there is no such folder"),
        (("--json", "no/b.json"), "there is no folder 'no'"),
    ],
)
def test_a_bench_that_cannot_be_measured_says_so_first(
    depal: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, words: Sequence[str], message: str
) -> None:
    """Before any scene is made."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(
        "depal.studies.perception.scenes.scene", lambda *_: pytest.fail("a scene was made")
    )
    status, _, err = depal("bench", "perception", *words)
    assert status == 2
    assert message in " ".join(err.split())
