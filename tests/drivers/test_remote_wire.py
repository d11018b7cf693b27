"""The wire: what is sent comes as it was, and what is no message does no harm."""

import asyncio
import tracemalloc

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from depal.cell.files import shipped_cell
from depal.domain import BoxId, Detection, Gtin, Recognition
from depal.errors import DeviceError
from depal.geometry import OrientedBox, Pose
from depal.logistics import read_delivery
from depal.ports import Frame, Question, Trajectory, View, Watch
from depal.ports.wire import messages as m
from depal.ports.wire.codec import HEAD, LARGEST, Table, encoded, packed, received, unpacked
from depal.ports.wire.values import Path, Photo, Sightings

LAYOUT, DELIVERY = shipped_cell("default"), read_delivery("dev-035")

numbers = st.floats(-1e6, 1e6)
names = st.text(max_size=20)
questions = st.builds(
    Question,
    id=names,
    text=names,
    choices=st.lists(names, min_size=1, max_size=4).map(tuple),
    about=names,
    at=st.none() | st.tuples(numbers, numbers, numbers),
    gtin=st.none() | names.map(Gtin),
)
calls = st.one_of(
    st.builds(m.Hello, st.integers(0, 2**31), st.integers(0, 2**31)),
    st.builds(m.Halt, names),
    st.builds(m.Fold, st.booleans()),
    st.builds(m.Suck, st.lists(st.tuples(names, st.integers(0, 9))).map(tuple)),
    st.builds(m.Take, st.integers(-9, 9)),
    st.builds(m.Do, questions, names),
    st.builds(m.Ask, questions),
    st.builds(m.Lifted, names.map(BoxId)),
    st.sampled_from([m.Release(), m.Read(), m.Look(), m.Judge(), m.Beat(), m.Shutdown()]),
    st.just(m.Build(LAYOUT, DELIVERY, 3, "normal", 7)),
)


def heard(data: bytes, kind: type = m.Request) -> object:
    """What somebody receives who is sent these bytes and nothing more."""

    async def work() -> object:
        reader = asyncio.StreamReader()
        reader.feed_data(data)
        reader.feed_eof()
        return await received(reader, msgspec.msgpack.Decoder(kind))

    return asyncio.run(work())


@given(number=st.integers(0, 2**31), call=calls)
def test_a_call_comes_as_it_was_sent(number: int, call: m.Call) -> None:
    """Whole cells and deliveries, too."""
    assert heard(encoded(m.Request(number, call))) == m.Request(number, call)


@given(call=calls, cut=st.integers(0, 10_000))
def test_a_call_that_was_cut_off_is_an_end_and_no_call(call: m.Call, cut: int) -> None:
    """Wherever it was cut."""
    data = encoded(m.Request(1, call))
    with pytest.raises(EOFError):
        heard(data[: min(cut, len(data) - 1)])


@given(st.binary(max_size=200))
def test_bytes_that_are_no_message_are_an_error_with_a_name(body: bytes) -> None:
    """Or a message, by chance; nothing else."""
    try:
        found = heard(HEAD.pack(len(body)) + body)
    except DeviceError as error:
        assert "what came is no message" in str(error)  # noqa: PT017 - a message is no error
    else:
        assert isinstance(found, m.Request)


@given(call=calls, at=st.floats(0.0, 1.0, exclude_max=True), byte=st.integers(0, 255))
def test_one_wrong_byte_is_an_error_or_another_message(call: m.Call, at: float, byte: int) -> None:
    """Invalid text, wrong types, wrong lengths."""
    data = bytearray(encoded(m.Request(1, call)))
    data[HEAD.size + int(at * (len(data) - HEAD.size))] = byte
    try:
        found = heard(bytes(data))
    except (DeviceError, EOFError):
        return
    assert isinstance(found, m.Request)


@pytest.mark.parametrize(
    "head", [b"\xdd\xff\xff\xff\xff", b"\xdf\xff\xff\xff\xff", b"\xdb\xff\xff\xff\xff"]
)
def test_a_length_that_is_not_there_takes_no_memory(head: bytes) -> None:
    """Four thousand million cups, in a message of some bytes."""
    start = msgspec.msgpack.encode({"number": 1, "call": {"type": "Suck", "cups": ()}})
    body = start.replace(b"\x90", head)
    tracemalloc.start()
    with pytest.raises(DeviceError):
        heard(HEAD.pack(len(body)) + body)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 2**20


def test_a_message_that_is_too_long_is_neither_sent_nor_read() -> None:
    """Both sides look at its length before anything else."""
    with pytest.raises(DeviceError, match=f"expected at most {LARGEST}"):
        encoded(m.Halt("x" * (LARGEST + 1)))
    with pytest.raises(DeviceError, match=f"of {LARGEST + 1} bytes; expected at most {LARGEST}"):
        heard(HEAD.pack(LARGEST + 1))


@given(npst.arrays(np.float32, npst.array_shapes(max_dims=3, max_side=5)))
def test_an_array_of_any_shape_comes_as_it_was(array: np.ndarray) -> None:
    """Not-a-numbers and infinities, too; what came may be written to."""
    table = msgspec.msgpack.decode(msgspec.msgpack.encode(packed(array)), type=Table)
    found = unpacked(table)
    assert (found.shape, found.dtype) == (array.shape, array.dtype)
    assert found.tobytes() == array.tobytes()
    assert found.flags.writeable


def test_an_array_that_is_stored_otherwise_comes_as_it_was() -> None:
    """Columns first, and in steps."""
    array = np.arange(24.0).reshape(4, 6)
    for other in (array.T, array[::2, ::-3]):
        assert (unpacked(packed(other)) == other).all()


@given(st.integers(1, 30), st.floats(0.001, 0.1), st.lists(st.tuples(numbers, numbers), max_size=3))
def test_a_trajectory_comes_as_it_was(
    n: int, step: float, allowances: list[tuple[float, float]]
) -> None:
    """To the bit, with its allowances."""
    sent = Trajectory(
        np.arange(n) * step, np.full((n, 6), 0.1), np.full((n, 6), -0.3), tuple(allowances)
    )
    kind = type(Path.of(sent))
    came = msgspec.msgpack.decode(msgspec.msgpack.encode(Path.of(sent)), type=kind).trajectory
    for name in ("times", "positions", "velocities"):
        assert getattr(came, name).tobytes() == getattr(sent, name).tobytes()
    assert came.allowances == sent.allowances


@pytest.mark.parametrize(
    ("times", "positions", "velocities", "message"),
    [
        (np.zeros(0), np.zeros((0, 6)), np.zeros((0, 6)), "shapes"),
        (np.arange(3.0), np.zeros((3, 5)), np.zeros((3, 5)), "shapes"),
        (np.arange(3.0), np.zeros((3, 6)), np.zeros((2, 6)), "shapes"),
        (np.zeros((1, 1)), np.zeros((1, 6)), np.zeros((1, 6)), "shapes"),
        (np.zeros(3), np.zeros((3, 6)), np.zeros((3, 6)), "times do not rise from 0"),
        (np.arange(3.0) + 1, np.zeros((3, 6)), np.zeros((3, 6)), "times do not rise from 0"),
        (np.array([0, np.nan]), np.zeros((2, 6)), np.zeros((2, 6)), "times do not rise from 0"),
    ],
)
def test_what_is_no_trajectory_is_refused(
    times: np.ndarray, positions: np.ndarray, velocities: np.ndarray, message: str
) -> None:
    """Before the arm hears of it."""
    with pytest.raises(DeviceError, match=message):
        _ = Path(packed(times), packed(positions), packed(velocities), ()).trajectory


def test_a_view_and_a_frame_come_as_they_were() -> None:
    """A recognised box is one, a detected box is one."""
    shape = OrientedBox(Pose((1.0, 2.0, 3.0)), (0.1, 0.2, 0.3))
    view = View(1.5, (Detection(BoxId("b1"), shape), Recognition(BoxId("b2"), shape, Gtin("123"))))
    came = msgspec.msgpack.decode(msgspec.msgpack.encode(Sightings.of(view)), type=Sightings)
    assert came.view == view
    k = ((1.0, 0.0, 2.0), (0.0, 1.0, 2.0), (0.0, 0.0, 1.0))
    colour = np.arange(18, dtype=np.uint8).reshape(2, 3, 3)
    frame = Frame(0.5, colour, np.ones((2, 2), np.float32), k, k, Pose((1.0, 0.0, 0.0)))
    photo = msgspec.msgpack.decode(msgspec.msgpack.encode(Photo.of(frame)), type=Photo).frame
    assert (photo.colour == colour).all()
    assert (photo.depth == frame.depth).all()
    assert (photo.taken, photo.colour_k, photo.cell_from_camera) == (0.5, k, frame.cell_from_camera)


@given(
    least=st.dictionaries(st.sampled_from(["front", "lower"]), st.floats(0.0, 1e5)),
    load=st.none() | st.floats(0.0, 60.0),
    vacuum=st.floats(0.0, 1e5),
    weight=st.floats(0.0, 60.0),
)
def test_a_watch_that_was_sent_sees_what_it_would_have_seen(
    least: dict[str, float], load: float | None, vacuum: float, weight: float
) -> None:
    """An idle one sees nothing."""
    watch = Watch(tuple(least.items()), load)
    came = msgspec.msgpack.decode(msgspec.msgpack.encode(watch), type=Watch)
    readings = {"front": vacuum, "lower": vacuum}
    reason = watch.reason(readings, lambda: weight)
    assert came.reason(readings, lambda: weight) == reason
    assert not (watch.idle and reason)
