"""A cell is read, and asked which places a box gets into and where it could stand there."""

from depal.cell.checking import BoxSize, check_cell
from depal.cell.files import find_cell
from depal.domain import BoxId, PlaceId
from depal.logistics.placing import Books, Held, find_spots

layout = find_cell("small_trolleys")  # or a file of your own
box = BoxSize("crate", (0.30, 0.40, 0.25), 6.0)  # depth, width, height [m]; mass [kg]
report = check_cell(layout, [box])
for place, share in report.reached.items():
    print(f"{place}: the arm reaches {share:.0%} of the floor with a {box.name}")

books = Books.empty(layout.places.values())
place = PlaceId("trolley_1/level_1")
held = Held(box.size, box.mass)
for number in range(1, 9):
    spots = find_spots(books.at(place), held, limit=1)
    if not spots:
        print(f"no room for crate {number}")
        break
    x, y, z = spots[0].corner
    print(f"crate {number}: {x:.2f} m deep, {y:+.2f} m aside, {z:.2f} m high")
    books = books.put(place, spots[0].standing(BoxId(f"crate {number}"), box.mass))
print(f"{place} is {books.at(place).fill:.0%} full")
