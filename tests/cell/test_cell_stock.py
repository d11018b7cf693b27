"""The stock follows the journal: what is told and what is read are the same movements."""

from cells_at_work import Cell

from depal.cell.stock import movement_id, movements_in
from depal.executive.events import encode
from depal.executive.journal import Entry, MemoryJournal
from depal.logistics.store import Database, LocalStore, StockProjection
from depal.ports import Movement


def test_the_journal_tells_of_the_same_movements_as_the_cell() -> None:
    """Read into an empty store, and again after the cell has told them: each counts once."""
    cell = Cell(3).works()
    facts = cell.work.runtime.engine.state.facts
    journal = MemoryJournal()
    for event in cell.events:
        entry = Entry(event.at, type(event).__name__, encode(event))
        journal.append([entry], durable=False)
    stored = {(d.box, d.gtin, d.place) for d in cell.work.departures.sequence}
    with LocalStore(Database()) as store:
        stock = StockProjection(store.database, lambda record: movements_in(record, facts))
        stock.catch_up(journal)
        read = store.movements()
        assert {(m.box, m.gtin, m.place) for m in read} == stored
        for box, gtin, place in stored:
            assert place is not None
            store.note(Movement(movement_id(box, place), box, gtin, place, 1.0))
        stock.catch_up(journal)
        assert store.movements() == read
