"""Generated requests against the API, by its own OpenAPI document: 0 server errors, 0 hangs.

    python scripts/fuzz_api.py --requests 20000

Every operation is called with generated input, alone and in sequences that its links make, with
good credentials of each role in turn; then each is made to succeed at least 20 times. An answer
that the document does not describe is an error as well.
"""

import argparse
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import schemathesis
from hypothesis import HealthCheck, Phase, given, settings
from rich.console import Console
from rich.table import Table

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "server"))

from api_recipes import SUCCESSES, succeed
from sites import PEOPLE, REACHED, site_over

from depal.server.api import build_app
from depal.server.roles import Role

STATEFUL, STEPS = 0.2, 10
"""The share of the requests that are made in sequences, and how long these are."""

SLOW = 5.0
"""An answer that takes longer counts as a hang [s]."""

CHECKS = [
    schemathesis.checks.not_a_server_error,
    schemathesis.checks.status_code_conformance,
    schemathesis.checks.content_type_conformance,
    schemathesis.checks.response_schema_conformance,
]


class Tally:
    """What came of the requests."""

    def __init__(self) -> None:
        """None yet."""
        self.by_operation: dict[str, Counter[int]] = {}
        self.slowest = 0.0
        self.failures: list[str] = []

    @property
    def requests(self) -> int:
        """How many there were."""
        return sum(sum(counts.values()) for counts in self.by_operation.values())

    def note(self, label: str, status: int, seconds: float) -> None:
        """One more."""
        self.by_operation.setdefault(label, Counter())[status] += 1
        self.slowest = max(self.slowest, seconds)
        if status >= 500:  # noqa: PLR2004 - HTTP's own number
            self.failures.append(f"{label}: {status}")

    @property
    def least_successes(self) -> tuple[int, str]:
        """The operation that succeeded least often."""
        return min(
            (sum(n for status, n in counts.items() if status < 300), label)  # noqa: PLR2004
            for label, counts in self.by_operation.items()
        )


def fuzz(folder: Path, requests: int, seed: int) -> Tally:
    """So many requests against a site in a folder."""
    site = site_over(folder)
    app = build_app(site, REACHED)
    schema = schemathesis.openapi.from_asgi("/openapi.json", app)
    _, token = site.tokens.add("fuzz", 300.0)
    tally, turn = Tally(), Counter()

    def credentials() -> dict[str, str]:
        turn["n"] += 1
        role = list(Role)[turn["n"] % len(Role)]
        if role is Role.SERVICE:
            return {"Authorization": f"Bearer {token}"}
        if not any(person.name == PEOPLE[role] for person in site.accounts.list()):
            role = Role.INTEGRATOR
        secret = site.sessions.open(PEOPLE[role])
        return {"Cookie": f"depal={secret}", "Origin": "http://testserver"}

    def call(case: schemathesis.Case) -> object:
        before = time.perf_counter()
        response = case.call(headers=credentials())
        tally.note(case.operation.label, response.status_code, time.perf_counter() - before)
        try:
            case.validate_response(response, checks=CHECKS)
        except Exception as error:  # noqa: BLE001 - whatever a check says is reported
            tally.failures.append(f"{case.operation.label}: {str(error)[:400]}")
        return response

    quiet = {
        "database": None,
        "deadline": None,
        "suppress_health_check": list(HealthCheck),
        "phases": [Phase.generate],
    }
    schema = schema.exclude(operation_id="stream_events")  # it goes on until somebody ends it
    operations = [result.ok() for result in schema.get_all_operations()]
    each = max(1, round(requests * (1.0 - STATEFUL) / len(operations)))
    for operation in operations:

        @settings(max_examples=each, derandomize=seed == 0, **quiet)
        @given(case=operation.as_strategy())
        def generated(case: schemathesis.Case) -> None:
            call(case)

        generated()
    _stateful(schema, call, lambda: tally.requests < requests, quiet)
    succeed(app, site, tally.note)
    return tally


def _stateful(
    schema: object, call: object, more: Callable[[], bool], quiet: dict[str, object]
) -> None:
    machine = schema.as_state_machine()  # type: ignore[attr-defined]

    class Sequences(machine):  # type: ignore[misc,valid-type]
        """Requests that use what the ones before have made."""

        def call(self, case: schemathesis.Case, **kwargs: object) -> object:
            """One of them."""
            del kwargs
            return call(case)  # type: ignore[operator]

        def validate_response(self, *given: object, **kwargs: object) -> None:
            """It was validated when it came."""

    # The site remembers, so that no sequence can be run again: each is an example of its own.
    one = settings(max_examples=1, stateful_step_count=STEPS, **quiet)
    while more():
        Sequences.run(settings=one)


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--requests", type=int, default=3000)
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tally = fuzz(Path(folder), asked.requests, asked.seed)
    table = Table("operation", "requests", "2xx", "4xx", "5xx")
    for label, counts in sorted(tally.by_operation.items()):
        classes = [sum(n for status, n in counts.items() if status // 100 == k) for k in (2, 4, 5)]
        table.add_row(label, str(sum(counts.values())), *map(str, classes))
    console = Console()
    console.print(table)
    for failure in tally.failures[:20]:
        console.print(failure, style="red", markup=False)
    least, label = tally.least_successes
    console.print(
        f"{tally.requests} requests, {len(tally.failures)} failures, slowest answer "
        f"{tally.slowest:.2f} s, least successes {least} ({label})"
    )
    return int(bool(tally.failures) or tally.slowest > SLOW or least < SUCCESSES)


if __name__ == "__main__":
    sys.exit(main())
