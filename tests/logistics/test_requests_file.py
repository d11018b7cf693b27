"""Files of requests, and requests for what a delivery does not have."""

import contextlib
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.domain import BoxId, Delivery, Gtin, Request
from depal.errors import RequestError
from depal.logistics import check_requests, read_requests

Complaint = Callable[..., str]

TEA, RICE = Gtin("12000823098180"), Gtin("12000807013116")
TIME = "a time such as 95 s, 1.5 min or 1 h"
DUE = (
    "when the request should be served, since the start of the run: "
    "95 s, 2 min, 1 h or a number of seconds"
)
SHARE = "importance of the request, a number from 0 to 1"


def test_a_file_gives_requests_in_its_order(tmp_path: Path, toy_delivery: Delivery) -> None:
    """The format's own example, with every way to write a time."""
    path = tmp_path / "wishes.yaml"
    path.write_text(
        f"""# a comment
- {{at: 0 s, gtin: "{TEA}", priority: 0.8}}
- {{at: 95 s, gtin: '{RICE}', priority: 3e-1, due: 400.5}}
- box: b1
  priority: 1
  at: 1.5 min
  due: 2h
""",
        encoding="utf-8-sig",
    )
    assert read_requests(path, toy_delivery) == (
        Request(priority=0.8, gtin=TEA),
        Request(priority=0.3, gtin=RICE, arrived=95, due=400.5),
        Request(priority=1, box=BoxId("b1"), arrived=90, due=7200),
    )
    assert read_requests(path) == read_requests(path, toy_delivery)


def test_an_empty_list_means_that_nothing_is_wanted(tmp_path: Path) -> None:
    """Said on purpose, as opposed to an empty file."""
    (tmp_path / "none.yaml").write_text("[]")
    assert read_requests(tmp_path / "none.yaml") == ()


MISTAKES = [
    ("", "is empty; expected a list of requests; [] for none"),
    ("a: 1", "line 1: an object is not a list; expected a list of requests"),
    ("\ntea", "line 2: 'tea' is not a list; expected a list of requests"),
    ("- [", "line 1, column 4: not YAML: expected the node content, but found '<stream end>'"),
    (
        "- box: b1\n\tpriority: 1",
        "line 2, column 1: not YAML: found character '\\t' that cannot start any token",
    ),
    (
        "- 1\n---\n- 2",
        (
            "line 2, column 1: not YAML: expected a single document in the stream, "
            "but found another document"
        ),
    ),
    ("- a\n- \x07", r"line 2: '\x07' is no character for YAML"),
    ('- "\\UFFFFFFFF"', "an escape in quotes stands for no character"),
    ("[" * 1500, "lists within lists, too deep to be requests"),
    (
        "- tea",
        (
            "line 1, [0]: 'tea' is text, not an object; "
            "expected a product or one perceived box that is wanted: either `gtin` or `box`"
        ),
    ),
    ("- {box: b, priority: 2}", f"line 1, [0].priority: 2 is above 1: per cent?; expected {SHARE}"),
    ("- {box: b, priority: 200}", f"line 1, [0].priority: 200 is above 1; expected {SHARE}"),
    ("- {box: b, priority: -1}", f"line 1, [0].priority: -1 is below 0; expected {SHARE}"),
    (
        "- {box: b, priority: .nan}",
        f"line 1, [0].priority: NaN is not a finite number; expected {SHARE}",
    ),
    (
        "- {box: b, priority: true}",
        f"line 1, [0].priority: true is not a number; expected {SHARE}",
    ),
    (
        "- {box: b, priority: yes}",
        f"line 1, [0].priority: 'yes' is text, not a number; expected {SHARE}",
    ),
    (
        "- {box: b, priority: !!int x}",
        f"line 1, [0].priority: 'x' is text, not a number; expected {SHARE}",
    ),
    (
        "- {box: b, priority: !wish 0.3}",
        "line 1, [0].priority: the tag '!wish' has no meaning here",
    ),
    ("- {box: b}", f"line 1, [0].priority: is missing; expected {SHARE}"),
    ("- {priority: 1}", "line 1, [0]: neither gtin nor box; expected one of them"),
    (
        f'- {{priority: 1, box: b, gtin: "{TEA}"}}',
        "line 1, [0]: both gtin and box; expected one of them",
    ),
    (
        f"- {{priority: 1, gtin: {TEA}}}",
        (
            f"line 1, [0].gtin: {TEA} is a number, which loses leading zeros: put it in quotes; "
            "expected the wanted product's trade item number, in quotes"
        ),
    ),
    (
        "- {priority: 1, gtin: '12000823098181'}",
        (
            "line 1, [0].gtin: '12000823098181' ends in the wrong check digit 1; "
            "expected 0, as in 12000823098180"
        ),
    ),
    (
        "- {priority: 1, box: 7}",
        (
            "line 1, [0].box: 7 is a number, which loses leading zeros: put it in quotes; "
            "expected the wanted box's name"
        ),
    ),
    ("- {priority: 1, box: ''}", "line 1, [0].box: is empty; expected the wanted box's name"),
    (
        "- {priority: 1, box: null}",
        "line 1, [0].box: null is not text; expected the wanted box's name",
    ),
    (
        "- priority: 1\n  box: b\n  priority: 0",
        "line 1, [0].priority: the key stands here twice; expected every key once",
    ),
    (
        "- {priority: 1, gtin: 0123}",
        "line 1, [0].gtin: '0123' has 4 digits; expected 8, 12, 13 or 14 digits",
    ),
    (
        "- priority: 1\n  box: b\n  prio: 0",
        "line 3, [0].prio: unknown key; there is: at, box, due, gtin, priority",
    ),
    (
        "- {priority: 1, box: b, [a]: 0}",
        "line 1, [0]['a list']: unknown key; there is: at, box, due, gtin, priority",
    ),
    ("- {priority: 1, box: b, at: 1:30}", f"line 1, [0].at: '1:30' is no time; expected {TIME}"),
    ("- {priority: 1, box: b, at: '95'}", f"line 1, [0].at: '95' is no time; expected {TIME}"),
    ("- {priority: 1, box: b, at: -3 s}", f"line 1, [0].at: '-3 s' is no time; expected {TIME}"),
    (
        "- {priority: 1, box: b, at: -3}",
        "line 1, [0].at: -3 s is before the start of the run; expected 0 s or later",
    ),
    (
        "- {priority: 1, box: b, at: 1790000000}",
        (
            "line 1, [0].at: 1.79e+09 s is more than a week; "
            "expected a time since the start of the run, such as 95 s"
        ),
    ),
    (
        "- {priority: 1, box: b, due: [1]}",
        f"line 1, [0].due: a list is not a number; expected {DUE}",
    ),
    (
        "- {priority: 1, box: b, at: 2 min, due: 90 s}",
        "line 1, [0].due: 90 s is before the request comes; expected 120 s or later",
    ),
    (b"- \xff", "line 1: byte 0xff is not UTF-8; expected a text file in UTF-8"),
    (b" " * (1024 * 1024 + 1), "is larger than 1 MiB; expected a smaller file"),
]


@pytest.mark.parametrize(
    ("content", "message"), MISTAKES, ids=[message[:50] for _, message in MISTAKES]
)
def test_a_mistake_in_a_request_is_named_by_line_item_and_field(
    complaint: Complaint, content: str | bytes, message: str
) -> None:
    """What, where, what was expected, what exists: pinned word for word."""
    assert complaint(content, "in.yaml", read_requests) == f"RequestError: in.yaml: {message}"


def test_all_mistakes_of_a_file_are_reported_together(
    complaint: Complaint, toy_delivery: Delivery
) -> None:
    """Those of the shape and those against the delivery."""
    content = (
        '- {gtin: "12000823098197", priority: 7}\n- tea\n'
        '- {box: b, priority: 1, colour: red, at: now}\n- {gtin: "1", priority: 0}\n'
    )
    said = complaint(content, "in.yaml", lambda path: read_requests(path, toy_delivery))
    assert [line.split(": ")[0].strip() for line in said.splitlines()[1:]] == [
        "line 1, [0].gtin",
        "line 1, [0].priority",
        "line 2, [1]",
        "line 3, [2].at",
        "line 3, [2].colour",
        "line 4, [3].gtin",
    ]


def test_a_product_that_does_not_come_cannot_be_requested(
    complaint: Complaint, toy_delivery: Delivery
) -> None:
    """From a file and as a value alike; with what is close and what there is."""
    stranger = (
        "'12000823098197' is not on the note of the delivery; expected a product of the note; "
        f"did you mean '{TEA}'? (there is: {RICE}, {TEA})"
    )
    content = '- {gtin: "12000823098197", priority: 1}'
    said = complaint(content, "in.yaml", lambda path: read_requests(path, toy_delivery))
    assert said == f"RequestError: in.yaml: line 1, [0].gtin: {stranger}"
    requests = [
        Request(0.5, gtin=TEA),
        Request(0.5, box=BoxId("b1")),
        Request(1, gtin=Gtin("12000823098197")),
    ]
    check_requests(requests[:2], toy_delivery)
    with pytest.raises(RequestError) as caught:
        check_requests(requests, toy_delivery)
    assert str(caught.value) == f"requests[2].gtin: {stranger}"


def test_many_requests_for_products_that_do_not_come_are_cut_and_counted(
    toy_delivery: Delivery,
) -> None:
    """The error itself holds all of them."""
    with pytest.raises(RequestError) as caught:
        check_requests([Request(0.5, gtin=Gtin("96385074"))] * 60, toy_delivery)
    said = str(caught.value).splitlines()
    assert (said[0], said[-1], len(said)) == ("60 problems", "  and 10 more", 52)
    assert said[1].startswith("  requests[0].gtin: '96385074' is not on the note")
    assert len(caught.value.problems) == 60


def test_a_missing_file_of_requests_names_those_that_exist(tmp_path: Path) -> None:
    """By their own endings."""
    (tmp_path / "wishes.yml").touch()
    (tmp_path / "wish.json").touch()
    with pytest.raises(RequestError, match=r"no such file; did you mean 'wishes\.yml'\?$"):
        read_requests(tmp_path / "wishes.yaml")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that all examples share."""
    return tmp_path_factory.mktemp("requests")


wanted = st.fixed_dictionaries({"gtin": st.sampled_from([TEA, RICE])}) | st.fixed_dictionaries(
    {"box": st.text("b0123456789/", min_size=1)}
)
times = st.tuples(st.floats(0, 3600), st.floats(0, 3600)).map(sorted)


@settings(max_examples=60, deadline=None)
@given(
    items=st.lists(st.tuples(wanted, st.floats(0, 1), times, st.booleans()), max_size=5),
)
def test_requests_survive_writing_and_reading(
    folder: Path, items: list[tuple[dict[str, str], float, list[float], bool]]
) -> None:
    """To the last bit, whoever writes the YAML."""
    raw = [
        {**what, "priority": priority, "at": at, **({"due": due} if has_due else {})}
        for what, priority, (at, due), has_due in items
    ]
    path = folder / "any.yaml"
    path.write_text(yaml.safe_dump([{**item} for item in raw]), encoding="utf-8")
    assert read_requests(path) == tuple(
        Request(
            priority,
            gtin=Gtin(what["gtin"]) if "gtin" in what else None,
            box=BoxId(what["box"]) if "box" in what else None,
            arrived=at,
            due=due if has_due else None,
        )
        for what, priority, (at, due), has_due in items
    )


SCRAPS = (
    "- |{|}|[|]|: |, |\n| |&a |*a |!!int |!!float |!x |<<|\"|'|\\|gtin|box|at|due|priority|0.5|"
    "1e999|95 s|\t|? |---\n|%YAML 1.|!!timestamp |!!binary |null|-.inf|#|> |@|!<a>"
)
scraps = st.lists(st.sampled_from([*SCRAPS.split("|"), "|"]), max_size=25).map("".join)


@settings(max_examples=150, deadline=None)
@given(content=st.binary(max_size=60) | scraps)
def test_arbitrary_text_raises_nothing_but_a_request_error(
    folder: Path, content: bytes | str
) -> None:
    """Bytes, and scraps of YAML in any order."""
    data = content if isinstance(content, bytes) else content.encode()
    (folder / "scraps.yaml").write_bytes(data)
    with contextlib.suppress(RequestError):
        read_requests(folder / "scraps.yaml")
