"""The store's data: what was written comes back, once, and by a version that is understood."""

import asyncio
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.domain import BoxId, Delivery, Gtin, Place, PlaceId
from depal.errors import DeliveryError, DeviceError, JournalError, SettingError
from depal.executive.clock import run_simulated
from depal.executive.journal import Entry, MemoryJournal, Record
from depal.geometry import Pose
from depal.logistics import shipped_deliveries
from depal.logistics.store import (
    Database,
    LocalStore,
    StockProjection,
    assign_places,
    by_storage,
    newest,
)
from depal.ports import Movement, StoreSystem

TEA = Gtin("12000823098180")


def place(name: str, z: float, height: float = 0.5) -> Place:
    """A compartment at a height above the floor [m]."""
    return Place(PlaceId(name), Pose((0.0, 0.0, z)), (0.7, height), 0.6)


PLACES = [
    place(f"trolley_{bay}/level_{level}", 0.2 + 0.6 * level)
    for bay in (1, 2, 3)
    for level in (1, 2, 3)
]


@pytest.fixture
def store() -> Iterator[LocalStore]:
    """An empty store in memory."""
    with LocalStore() as store:
        yield store


@pytest.fixture(scope="module")
def delivery() -> Delivery:
    """A real one."""
    return shipped_deliveries()[0]


def movement(number: int, level: str = "trolley_1/level_1") -> Movement:
    """A case of tea that went into a place."""
    return Movement(f"m{number}", BoxId(f"b{number}"), TEA, PlaceId(level), float(number))


def test_a_seeded_store_knows_note_products_and_places(
    store: LocalStore, delivery: Delivery
) -> None:
    """Seeding again changes nothing."""
    for _ in range(2):
        store.seed_places([delivery], PLACES)
    note = store.note_of(delivery.id)
    assert note == Delivery(delivery.id, delivery.pallet_size, delivery.lines)
    for gtin, product in delivery.products.items():
        assert store.product(gtin) == product
        assert sorted(store.assignment(gtin)) == sorted(each.id for each in PLACES)
    assert store.note_of("none") is None
    assert store.product(TEA) is None


def test_what_the_store_was_told_about_a_place_outlives_seeding(
    store: LocalStore, delivery: Delivery
) -> None:
    """A plan does not overrule a person."""
    store.seed_places([delivery], PLACES)
    gtin = delivery.lines[0].product.gtin
    store.assign({gtin: [PLACES[4].id]})
    store.seed_places([delivery], PLACES)
    assert store.assignment(gtin) == (PLACES[4].id,)


def test_the_store_answers_as_the_port_asks_and_takes_its_time(delivery: Delivery) -> None:
    """On the event loop's clock, which costs no time here."""

    async def ask(store: StoreSystem) -> tuple[float, tuple[PlaceId, ...], tuple[PlaceId, ...]]:
        known = await store.places_for(delivery.lines[0].product.gtin)
        unknown = await store.places_for(TEA)
        await store.moved(movement(1))
        return asyncio.get_running_loop().time(), known, unknown

    with LocalStore(delay=0.5) as store:
        store.seed_places([delivery], PLACES)
        now, known, unknown = run_simulated(ask(store))
        assert store.movements() == (movement(1),)
    assert now == pytest.approx(1.5)
    assert len(known) == len(PLACES)
    assert unknown == ()


@given(st.lists(st.integers(1, 9)))
def test_a_movement_that_is_told_twice_counts_once(numbers: list[int]) -> None:
    """And the stock is their sum."""
    with LocalStore() as store:
        fresh = [store.note(movement(number)) for number in numbers]
        assert sum(fresh) == len(set(numbers))
        assert store.movements() == tuple(movement(each) for each in dict.fromkeys(numbers))
        expected = {(PlaceId("trolley_1/level_1"), TEA): len(set(numbers))} if numbers else {}
        assert store.stock() == expected


def movements_of(record: Record) -> list[Movement]:
    """An event of kind "moved" holds the number of a movement."""
    return [movement(int(record.body))] if record.kind == "moved" else []


@given(st.lists(st.sampled_from(["1", "2", "3", "4", "x"]), max_size=12), st.integers(0, 12))
def test_the_stock_follows_a_journal_and_changes_once_for_each_event(
    bodies: list[str], stop: int
) -> None:
    """In one go or in two; what the journal tells twice counts once."""
    entries = [Entry(0.0, "other" if body == "x" else "moved", body) for body in bodies]
    expected = tuple(movement(int(body)) for body in dict.fromkeys(bodies) if body != "x")
    with LocalStore() as store, MemoryJournal() as journal:
        for part in (entries[:stop], entries[stop:]):
            journal.append(part, durable=False)
            projection = StockProjection(store.database, movements_of)
            assert projection.catch_up(journal) == journal.last == projection.last
        assert store.movements() == expected


def test_an_event_that_cannot_be_applied_leaves_no_trace(store: LocalStore) -> None:
    """Neither of it nor of those in its batch; after the repair all count once."""

    def broken(record: Record) -> list[Movement]:
        if record.body == "2":
            raise ValueError(record.body)
        return movements_of(record)

    with MemoryJournal() as journal:
        journal.append([Entry(0.0, "moved", body) for body in "123"], durable=False)
        with pytest.raises(ValueError, match="2"):
            StockProjection(store.database, broken).catch_up(journal)
        assert store.movements() == ()
        projection = StockProjection(store.database, movements_of)
        assert projection.last == 0
        assert projection.catch_up(journal) == 3
        assert len(store.movements()) == 3
        with pytest.raises(JournalError, match="knows event 3, and the journal ends at 1"):
            projection.catch_up(journal.cut(1))


def test_two_hands_on_one_projection_are_noticed(store: LocalStore) -> None:
    """While one applies its first batch the other has moved on."""
    with MemoryJournal() as journal:
        journal.append([Entry(0.0, "moved", str(n)) for n in range(1500)], durable=False)
        other = StockProjection(store.database, movements_of)

        class Meddled(MemoryJournal):
            """A journal during whose reading somebody else catches up."""

            last = journal.last

            def read(self, after: int = 0) -> Iterator[Record]:
                yield from list(journal.read(after))[:1000]
                other.catch_up(journal)
                yield from list(journal.read(after))[1000:]

        with pytest.raises(JournalError, match="moved from event 1000 to 1500 by another hand"):
            StockProjection(store.database, movements_of).catch_up(Meddled())
        assert len(store.movements()) == 1500


def test_the_data_outlives_the_process(tmp_path: Path, delivery: Delivery) -> None:
    """In a file."""
    url = f"sqlite:///{tmp_path / 'store.db'}"
    with LocalStore(Database(url)) as store:
        store.seed_places([delivery], PLACES)
        store.note(movement(1))
        before = {gtin: store.assignment(gtin) for gtin in delivery.products}
    with LocalStore(Database(url)) as store:
        assert {gtin: store.assignment(gtin) for gtin in delivery.products} == before
        assert store.movements() == (movement(1),)


def newer(path: Path) -> None:
    """A database of a version that does not exist yet."""
    Database(f"sqlite:///{path}").close()
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("UPDATE alembic_version SET version_num = '9999'")
        connection.commit()


def foreign(path: Path) -> None:
    """A database of something else."""
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("CREATE TABLE songs (name TEXT)")


def garbage(path: Path) -> None:
    """No database at all."""
    path.write_bytes(b"a shopping list, and no database " * 100)


def nothing(path: Path) -> None:
    """A folder that does not exist."""
    path.unlink(missing_ok=True)
    path.parent.rmdir()


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (
            newer,
            (
                "was written by a newer depal, with version 9999 of its tables; expected version "
                f"{newest()} or an older one; update depal, or name another database"
            ),
        ),
        (
            foreign,
            (
                "is a database of something else; expected an empty one, or one that depal wrote; "
                "its tables: songs"
            ),
        ),
        (garbage, "cannot be opened: file is not a database; expected a database"),
        (nothing, "cannot be opened: unable to open database file; expected a database"),
    ],
)
def test_a_database_that_cannot_be_used_is_refused_with_a_reason(
    tmp_path: Path, make: Callable[[Path], None], told: str
) -> None:
    """And is not changed."""
    path = tmp_path / "folder" / "store.db"
    path.parent.mkdir()
    make(path)
    before = path.read_bytes() if path.exists() else None
    url = f"sqlite:///{path}"
    with pytest.raises(SettingError) as caught:
        Database(url)
    assert str(caught.value) == f"{url}: {told}"
    assert (path.read_bytes() if path.exists() else None) == before


def test_what_is_no_url_is_refused() -> None:
    """With an example of one."""
    with pytest.raises(SettingError, match=r"store\.db: is no database.*sqlite:///store\.db"):
        Database("store.db")
    with pytest.raises(SettingError, match="is no database"):
        Database("nosuch://store")


def test_a_database_that_fails_later_says_that_nothing_was_changed(tmp_path: Path) -> None:
    """As a device would."""
    path = tmp_path / "store.db"
    with LocalStore(Database(f"sqlite:///{path}")) as store:
        with closing(sqlite3.connect(path)) as connection:
            connection.execute("DROP TABLE movements")
            connection.commit()
        with pytest.raises(DeviceError, match="nothing was changed: no such table: movements"):
            store.note(movement(1))


def test_wrong_assignments_and_a_second_delivery_of_a_name_are_refused(
    store: LocalStore, delivery: Delivery
) -> None:
    """Each with what exists."""
    store.seed_places([delivery], PLACES)
    gtin = delivery.lines[0].product.gtin
    with pytest.raises(SettingError, match="product 12000823098180: is not in the store's data"):
        store.assign({TEA: [PLACES[0].id]})
    with pytest.raises(SettingError, match="did you mean 'trolley_1/level_1'"):
        store.assign({gtin: [PlaceId("troley_1/level_1")]})
    other = Delivery(delivery.id, delivery.pallet_size, delivery.lines[1:])
    with pytest.raises(DeliveryError, match="another delivery"):
        store.seed_places([other], PLACES)


def test_neighbouring_products_share_a_home_and_the_heavy_ones_stand_low(
    delivery: Delivery,
) -> None:
    """The home's own levels come before other trolleys'."""
    places = assign_places([delivery], PLACES)
    homes = [order[0].split("/")[0] for _, order in sorted(places.items())]
    assert homes == sorted(homes)
    assert set(homes) == {"trolley_1", "trolley_2", "trolley_3"}
    for order in places.values():
        assert len({name.split("/")[0] for name in order[:3]}) == 1
    for home in set(homes):
        mine = [gtin for gtin, order in places.items() if order[0].startswith(home)]
        mine.sort(key=lambda gtin: -delivery.products[gtin].mass)
        levels = [places[gtin][0] for gtin in mine]
        assert levels == sorted(levels)


def test_a_place_that_could_never_hold_a_case_comes_last(delivery: Delivery) -> None:
    """Whatever its level."""
    low = place("trolley_1/level_0", 0.0, height=0.05)
    places = assign_places([delivery], [low, *PLACES])
    assert {order[-1] for order in places.values()} == {low.id}


def test_some_products_may_be_unknown_to_the_store(delivery: Delivery) -> None:
    """The same ones for the same seed; without a place all are."""
    deliveries = shipped_deliveries()
    every = {gtin for each in deliveries for gtin in each.products}
    some = assign_places(deliveries, PLACES, unknown_share=0.05, seed=1)
    assert some == assign_places(deliveries, PLACES, unknown_share=0.05, seed=1)
    assert 0.01 < 1 - len(some) / len(every) < 0.12
    assert set(assign_places(deliveries, PLACES)) == every
    assert assign_places([delivery], []) == {}


def test_the_storage_for_what_is_set_aside_can_be_left_out() -> None:
    """By its name, not by how it begins."""
    names = ["shelf/level_1", "shelf_2/level_1", "trolley_1/level_1"]
    layout = {PlaceId(name): place(name, 0.0) for name in names}
    assert [each.id for each in by_storage(layout, without="shelf")] == names[1:]


def older(path: Path) -> None:
    """A database as depal wrote it before there were migrations."""
    Database(f"sqlite:///{path}").close()
    with closing(sqlite3.connect(path)) as connection:
        names = [
            name
            for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")
        ]
        kept = {"products", "places", "product_places", "deliveries", "delivery_lines"}
        kept |= {"requests", "movements", "projections"}
        connection.execute("PRAGMA foreign_keys = OFF")
        for name in set(names) - kept:
            connection.execute(f"DROP TABLE {name}")
        connection.execute("CREATE TABLE schema (id INTEGER PRIMARY KEY, version INTEGER)")
        connection.execute("INSERT INTO schema VALUES (1, 1)")
        connection.commit()


def test_an_older_database_is_brought_up_to_date_and_a_copy_kept(tmp_path: Path) -> None:
    """What was in it stays; the tables are those that a new database has."""
    path, fresh = tmp_path / "store.db", tmp_path / "fresh.db"
    with LocalStore(Database(f"sqlite:///{path}")) as store:
        store.note(movement(1))
    older(path)
    with closing(sqlite3.connect(path)) as other:  # keeps the write-ahead log from being emptied
        other.execute("PRAGMA journal_mode = WAL")
        other.execute("UPDATE movements SET box = 'in the log alone'")
        other.commit()
        before = list(other.iterdump())
        with LocalStore(Database(f"sqlite:///{path}")) as store:
            assert [each.box for each in store.movements()] == ["in the log alone"]
    with closing(sqlite3.connect(tmp_path / "store.db.before-0001")) as copy:
        assert list(copy.iterdump()) == before
    Database(f"sqlite:///{fresh}").close()
    assert columns(path) == columns(fresh)


def columns(path: Path) -> dict[str, list[tuple[str, str, int, int]]]:
    """Name, type, whether it must be there, and its place in the key, by table."""
    with closing(sqlite3.connect(path)) as connection:
        names = connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'").fetchall()
        return {
            name: sorted(
                (column, kind.split("(")[0].replace("DOUBLE", "FLOAT"), needed, key)
                for _, column, kind, needed, _, key in connection.execute(
                    f"PRAGMA table_info({name})"
                )
            )
            for (name,) in names
        }
