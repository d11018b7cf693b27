"""How fast a served cell answers beside its simulation, camera and all.

    python scripts/measure_serve.py --seconds 60

A real delivery runs at real time. GET /api/v1/state is asked 50 times a second, and every event
of the journal is timed from the moment that the cell has decided it to the moment that a client
has it on its socket.
"""

import argparse
import json
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

import httpx2
import numpy as np
from rich.console import Console

from depal.drivers.remote.finding import card_of
from depal.executive.clock import Pace
from depal.logistics import read_delivery
from depal.server.records.documents import document_of
from kill_cell import NAME, PASSWORD, Cell

RATE = 50.0
"""States are asked for so often [1/s]."""

TARGETS = {"state_p99_ms": 50.0, "event_p95_ms": 100.0}


def ask_for_states(base: str, cookies: httpx2.Cookies, seconds: float) -> list[float]:
    """How long each answer took [s]; asked by the clock, whether or not the one before is there."""
    took: list[float] = []
    lock = threading.Lock()

    def once() -> None:
        with httpx2.Client(timeout=30.0, cookies=cookies) as client:
            client.get(f"{base}/api/v1/health")  # the connection is made
            while time.perf_counter() < until:
                at = next_at()
                time.sleep(max(at - time.perf_counter(), 0.0))
                before = time.perf_counter()
                client.get(f"{base}/api/v1/state").raise_for_status()
                with lock:
                    took.append(time.perf_counter() - before)

    start, until = time.perf_counter(), time.perf_counter() + seconds
    turn = iter(range(10**9))

    def next_at() -> float:
        with lock:
            return start + next(turn) / RATE

    threads = [threading.Thread(target=once) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return took


def listen(base: str, cookies: httpx2.Cookies, pace: Pace, until: float) -> list[float]:
    """How old each event was when it came [s]."""
    ages: list[float] = []
    with (
        httpx2.Client(timeout=30.0, cookies=cookies) as client,
        client.stream("GET", f"{base}/api/v1/events") as stream,
    ):
        for line in stream.iter_lines():
            if line.startswith("data: "):
                event: dict[str, Any] = json.loads(line[6:])
                decided = pace.origin + (event["at"] - pace.start) / pace.rate
                ages.append(time.monotonic() - decided)
            if time.monotonic() > until:
                break
    return ages


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--delivery", default="dev-035")
    parser.add_argument("--perception", default="camera")
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cell = Cell(Path(folder) / "data", 1.0, asked.perception)
        code = cell.link.split("code=")[1]
        cell("POST", "/first-account", json={"code": code, "name": NAME, "password": PASSWORD})
        cell("POST", "/deliveries", json=document_of(read_delivery(asked.delivery)))
        cell("POST", "/commands/start", json={})
        card = card_of(Path(folder) / "data")
        if card is None:
            raise RuntimeError("there is no world")
        until = time.monotonic() + asked.seconds
        ages: list[float] = []
        cookies = cell.cookies
        hearing = threading.Thread(
            target=lambda: ages.extend(listen(cell.base, cookies, card.pace, until)), daemon=True
        )
        hearing.start()
        took = ask_for_states(cell.base, cookies, asked.seconds)
        hearing.join(20.0)
        stored = cell("GET", "/state")["stored"]
        cell.end()
    figures = {
        "state_p50_ms": 1000 * float(np.percentile(took, 50)),
        "state_p99_ms": 1000 * float(np.percentile(took, 99)),
        "states": len(took),
        "event_p50_ms": 1000 * float(np.percentile(ages, 50)),
        "event_p95_ms": 1000 * float(np.percentile(ages, 95)),
        "events": len(ages),
        "stored": stored,
    }
    Console().print_json(json.dumps(figures))
    if asked.json is not None:
        asked.json.write_text(json.dumps(figures), encoding="utf-8")
    return int(any(figures[name] > target for name, target in TARGETS.items()))


if __name__ == "__main__":
    sys.exit(main())
