"""Figures in files: the same bytes, whole or not at all."""

import subprocess
import sys
from pathlib import Path

import matplotlib as mpl
import pytest
from drawing_samples import FIGURES, draw_table, figure_of
from matplotlib.figure import Figure

from depal.errors import SettingError
from depal.studies.drawing import save_figure


@pytest.mark.parametrize("name", FIGURES)
@pytest.mark.parametrize("suffix", ["png", "svg"])
def test_the_same_numbers_give_the_same_bytes(name: str, suffix: str, tmp_path: Path) -> None:
    """Drawn and saved twice, a figure is the same file."""
    first = save_figure(figure_of(name), tmp_path / f"first.{suffix}")
    second = save_figure(FIGURES[name](), tmp_path / f"second.{suffix}")
    assert first.read_bytes() == second.read_bytes()


def test_a_figure_saved_twice_is_the_same_file(tmp_path: Path) -> None:
    """Saving changes nothing in the figure."""
    figure = draw_table()
    files = [save_figure(figure, tmp_path / name) for name in ("1.png", "2.svg", "3.png", "4.svg")]
    assert files[0].read_bytes() == files[2].read_bytes()
    assert files[1].read_bytes() == files[3].read_bytes()


@pytest.mark.parametrize(
    ("name", "start"), [("a.png", b"\x89PNG"), ("a.SVG", b"<?xml"), ("a.pdf", b"%PDF")]
)
def test_the_suffix_says_the_format(name: str, start: bytes, tmp_path: Path) -> None:
    """Whatever its case; the file begins as that format does and has no date."""
    content = save_figure(draw_table(), tmp_path / name).read_bytes()
    assert content.startswith(start)
    assert b"Date" not in content


def test_a_png_is_two_thousand_pixels_wide(tmp_path: Path) -> None:
    """Sharp where a page shows it at 1,000."""
    content = save_figure(draw_table(), tmp_path / "a.png").read_bytes()
    assert int.from_bytes(content[16:20], "big") == 2000


def test_a_file_is_replaced_and_nothing_else_is_left(tmp_path: Path) -> None:
    """The temporary file becomes the figure."""
    target = tmp_path / "a.svg"
    target.write_text("old")
    save_figure(draw_table(), target)
    assert [path.name for path in tmp_path.iterdir()] == ["a.svg"]
    assert target.read_text().startswith("<?xml")


def test_matplotlibs_settings_stay_as_they_were(tmp_path: Path) -> None:
    """Neither drawing nor saving leaves a trace in them."""
    before = dict(mpl.rcParams)
    save_figure(draw_table(), tmp_path / "a.svg")
    assert dict(mpl.rcParams) == before


def test_drawing_never_loads_pyplot() -> None:
    """No windows, no current figure."""
    program = "import sys, depal.studies.drawing; sys.exit('matplotlib.pyplot' in sys.modules)"
    command = [sys.executable, "-c", program]
    assert subprocess.run(command, check=False).returncode == 0  # noqa: S603 - our own program


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (
            "fig8.gif",
            "figure: 'fig8.gif' ends in '.gif'; expected a name that ends in .png, .svg or .pdf",
        ),
        ("fig8", "figure: 'fig8' has no suffix; expected a name that ends in .png, .svg or .pdf"),
    ],
)
def test_another_suffix_is_refused(name: str, message: str, tmp_path: Path) -> None:
    """With the suffixes that there are."""
    with pytest.raises(SettingError) as refusal:
        save_figure(Figure(), tmp_path / name)
    assert str(refusal.value) == message
    assert not list(tmp_path.iterdir())


def test_a_missing_folder_is_refused_with_one_that_is_meant(tmp_path: Path) -> None:
    """Nothing is created."""
    (tmp_path / "figures").mkdir()
    folder = tmp_path / "figurs"
    with pytest.raises(SettingError) as refusal:
        save_figure(Figure(), folder / "fig8.png")
    assert str(refusal.value) == (
        f"figure: there is no folder {str(folder)!r} for 'fig8.png'; "
        "expected a folder that exists; did you mean 'figures'?"
    )
    assert not folder.exists()


def test_a_folder_below_a_missing_one_is_refused(tmp_path: Path) -> None:
    """Where nothing is near, nothing is proposed."""
    with pytest.raises(SettingError, match="expected a folder that exists; there is none"):
        save_figure(Figure(), tmp_path / "no" / "where" / "fig8.png")


def test_a_name_that_is_taken_by_a_folder_is_refused(tmp_path: Path) -> None:
    """And the temporary file is gone again."""
    target = tmp_path / "fig8.png"
    target.mkdir()
    with pytest.raises(SettingError) as refusal:
        save_figure(Figure(), target)
    assert str(refusal.value) == (
        f"figure: {str(target)!r} cannot be written: Is a directory; "
        "expected a file that may be written"
    )
    assert [path.name for path in tmp_path.iterdir()] == ["fig8.png"]
