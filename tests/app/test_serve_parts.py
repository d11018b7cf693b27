"""The parts around a served cell: questions, the feed of events, the backup, what is refused."""

import asyncio
import json
from pathlib import Path

import pytest

from depal.app.serve.backup import back_up
from depal.app.serve.feed import Feed
from depal.app.serve.person import ScreenPerson
from depal.app.serve.serving import Service, Serving, listen_at
from depal.errors import SettingError
from depal.executive.clock import LoopClock, run_simulated
from depal.executive.journal import Entry, SqliteJournal
from depal.executive.record import JOURNAL
from depal.logistics.store import Database
from depal.ports import Question
from depal.server.cell import Refusal
from depal.server.cellstate import QuestionState
from depal.server.events import PER_RUN

ASKED = Question("take/b1", "Take it?", ("taken", "no"), "b1")


class Hands:
    """Counts what people do."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.done: list[tuple[str, str]] = []

    async def do(self, question: Question, answer: str) -> None:
        """One more."""
        self.done.append((question.id, answer))


def test_the_first_of_two_answers_counts_and_is_done_once() -> None:
    """The second is told who has said what; what is no choice is refused."""
    hands, asked, answered = Hands(), [], []

    async def ask() -> str:
        person = ScreenPerson(
            3,
            LoopClock(),
            hands,
            asked.append,
            lambda name, choice, by, _at: answered.append((name, choice, by)),
        )
        task = asyncio.create_task(person.ask(ASKED))
        await asyncio.sleep(1.0)
        (state,) = person.open
        with pytest.raises(Refusal, match="is no answer; the choices are taken, no"):
            person.answer(state.id, "perhaps", "anna")
        person.answer(state.id, "no", "anna")
        with pytest.raises(Refusal, match="anna has answered this question: no"):
            person.answer(state.id, "taken", "otto")
        with pytest.raises(Refusal, match="no open question 'x'"):
            person.answer("x", "no", "otto")
        said = await task
        again = asyncio.create_task(person.ask(ASKED))
        await asyncio.sleep(1.0)
        assert person.open[0].id != state.id
        again.cancel()
        await asyncio.gather(again, return_exceptions=True)
        assert person.open == ()
        return said

    assert run_simulated(ask()) == "no"
    assert hands.done == [("take/b1", "no")]
    assert all(isinstance(state, QuestionState) for state in asked)
    assert [each[1:] for each in answered] == [("no", "anna")]


def journal(folder: Path, run: int, count: int) -> None:
    """A run with so many events."""
    place = folder / str(run)
    place.mkdir(parents=True)
    with SqliteJournal(place / JOURNAL) as kept:
        kept.append(
            [Entry(float(n), "Ticked", f'{{"at":{n}}}') for n in range(count)], durable=True
        )


def test_the_events_of_all_runs_are_one_row(tmp_path: Path) -> None:
    """In order, in pages, from any number on."""
    for run, count in ((1, 3), (2, 2), (10, 4)):
        journal(tmp_path, run, count)
    (tmp_path / "notes").mkdir()
    feed = Feed(tmp_path)
    whole = feed.after(0, 100)
    numbers = [event.sequence for event in whole]
    assert numbers == sorted(numbers)
    assert [(event.run, event.sequence % PER_RUN) for event in whole] == [
        (1, 1), (1, 2), (1, 3), (2, 1), (2, 2), (10, 1), (10, 2), (10, 3), (10, 4),
    ]  # fmt: skip
    assert feed.last == numbers[-1]
    paged: list[int] = []
    while page := feed.after(paged[-1] if paged else 0, 2):
        paged += [event.sequence for event in page]
    assert paged == numbers
    feed.wrote(11, 1)
    assert feed.last == 11 * PER_RUN + 1


def test_no_runs_are_no_events(tmp_path: Path) -> None:
    """Also where the folder is not there yet."""
    feed = Feed(tmp_path / "runs")
    assert (feed.last, feed.after(0, 10)) == (0, ())


def test_a_backup_is_a_folder_that_can_be_started_from(tmp_path: Path) -> None:
    """Taken while the database is open; nothing is left where it cannot be taken."""
    data = tmp_path / "data"
    data.mkdir()
    with Database(f"sqlite:///{data / 'store.db'}"):
        journal(data / "runs", 1, 3)
        (data / "runs" / "1" / "choices.jsonl").write_text("{}\n", encoding="utf-8")
        told = back_up(data, tmp_path / "copy")
    assert told.endswith("the store's data and 1 run")
    Database(f"sqlite:///{tmp_path / 'copy' / 'store.db'}").close()
    assert len(Feed(tmp_path / "copy" / "runs").after(0, 10)) == 3
    assert (tmp_path / "copy" / "runs" / "1" / "choices.jsonl").read_text("utf-8") == "{}\n"
    with pytest.raises(SettingError, match="exists already"):
        back_up(data, tmp_path / "copy")
    with pytest.raises(SettingError, match=r"there is no store\.db"):
        back_up(tmp_path / "nowhere", tmp_path / "other")
    assert not (tmp_path / "other").exists()


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        (Serving(cell="defualt"), "did you mean 'default'"),
        (Serving(perception="eyes"), "unknown perception 'eyes'"),
        (Serving(tasks=("nothing.task",)), "nothing.task"),
        (Serving(pace=0.0), "more than 0, at most 50"),
        (Serving(host="0.0.0.0"), "nothing is encrypted"),  # noqa: S104 - it is refused
    ],
)
def test_what_cannot_be_served_is_refused_before_anything_runs(
    tmp_path: Path, asked: Serving, told: str
) -> None:
    """Nothing is made in the data folder."""
    folder = tmp_path / "data"
    with pytest.raises(Exception, match=told):
        Service(Serving(**{**_fields(asked), "folder": folder}))
    assert not folder.exists()


def _fields(asked: Serving) -> dict[str, object]:
    return {name: getattr(asked, name) for name in asked.__dataclass_fields__}


def test_the_first_link_has_a_code_until_somebody_is_there(tmp_path: Path) -> None:
    """Later starts tell the address alone."""
    service = Service(Serving(folder=tmp_path / "data", perception="truth"))
    link = service.first_link(8080)
    assert link is not None
    assert link.startswith("http://127.0.0.1:8080/first?code=")
    code = link.split("code=")[1]
    assert service.site.codes.good(code)
    kept = json.dumps([place.id for place in service.site.cell.layout.places.values()])
    assert "trolley_1/level_1" in kept


def test_a_port_that_somebody_has_is_refused_before_anything_is_made() -> None:
    """With the port, and what to do."""
    with listen_at("127.0.0.1", 0) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(SettingError, match=f"listen at 127.0.0.1:{port}: .*; expected a free"):
            listen_at("127.0.0.1", port)
