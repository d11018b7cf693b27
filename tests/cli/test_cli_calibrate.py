"""`depal calibrate` as a stranger types it."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from depal.app.calibrate import simulated_cameras
from depal.cell.files import shipped_cell, shipped_text
from depal.perception.calibration import read_calibrations
from depal.perception.frames import RecordedFrame, write_frame_folder

Run = Callable[..., tuple[int, str, str]]


@pytest.mark.slow
def test_simulated_cameras_are_calibrated_written_and_drawn(depal: Run, tmp_path: Path) -> None:
    """The file is what other commands read."""
    report, plot = tmp_path / "c.json", tmp_path / "c.png"
    status, out, err = depal("calibrate", "--pictures", 1, "--json", report, "--plot", plot)
    assert (status, err) == (0, "")
    for word in ("front", "top", "depth scale", "residual", "7 of 7"):
        assert word in out
    assert plot.read_bytes().startswith(b"\x89PNG")
    fields = json.loads(report.read_text())
    assert {"version", "command", "cell", "source", "frames", "cameras"} <= set(fields)
    assert max(map(abs, fields["depth_off_truth"].values())) < 0.004
    found = read_calibrations(report)
    assert set(found) == {"front", "top"}
    for mount in shipped_cell().cameras:
        apart = [
            abs(a - b)
            for a, b in zip(
                found[mount.name].cell_from_camera.translation,
                mount.cell_from_camera.translation,
                strict=True,
            )
        ]
        assert max(apart) < 0.002


@pytest.mark.slow
def test_recorded_frames_are_calibrated(depal: Run, tmp_path: Path) -> None:
    """One camera's frames from a folder; a marker that was moved is told with status 1."""
    layout = shipped_cell()
    (mount,) = (mount for mount in layout.cameras if mount.name == "top")
    models, moment = simulated_cameras(layout, (mount,), 3)
    frame = models["top"].frame(moment, 0.0, 0)
    recorded = replace(RecordedFrame.of_frame(frame), cell_from_camera=None)
    write_frame_folder(tmp_path / "frames" / "top" / "000", recorded)
    folder = tmp_path / "frames"
    status, out, err = depal("calibrate", "--frames", folder)
    assert (status, err) == (0, "")
    assert "top" in out
    assert "front" not in out
    text = shipped_text("default")
    for old, new in (("[1.9, 1.42, 0.003]", "[1.9, 1.46, 0.003]"), ("[1.13, 0.2,", "[1.17, 0.2,")):
        assert old in text
        text = text.replace(old, new)
    cell = tmp_path / "mine.yaml"
    cell.write_text(text, "utf-8")
    status, out, _ = depal(
        "calibrate", "--frames", folder / "top", "--camera", "top", "--cell", cell
    )
    assert status == 1
    assert "camera top: rays miss the markers by " in " ".join(out.split())


def test_what_cannot_be_calibrated_is_refused_with_status_2(depal: Run, tmp_path: Path) -> None:
    """A camera that is none, a folder without frames, a cell without markers."""
    status, out, err = depal("calibrate", "--camera", "side")
    assert (status, out) == (2, "")
    assert "--camera: there is no camera 'side'; there is: front, top" in err
    status, _, err = depal("calibrate", "--frames", tmp_path)
    assert status == 2
    assert "has no folder named after a camera; expected frames in one of front, top" in err
    status, _, err = depal("calibrate", "--frames", tmp_path, "--camera", "top")
    assert status == 2
    assert "holds no frame" in err
    cell = tmp_path / "mine.yaml"
    text = shipped_text("default")
    cell.write_text(text[: text.index("fiducials:")], "utf-8")
    status, _, err = depal("calibrate", "--cell", cell)
    assert status == 2
    assert "fiducials: the cell has no markers to calibrate by" in err
