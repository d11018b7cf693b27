"""How fast a served cell answers beside its simulation, camera and all.

    python scripts/measure_serve.py --seconds 60

A real delivery runs at real time. GET /api/v1/state is asked 50 times a second, and every event
of the journal is timed from the moment that the cell has decided it to the moment that a client
has it on its socket.
"""

import argparse
import json
import os
import sys
import tempfile
import threading
import time
from collections.abc import Callable
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

TARGETS = {
    "state_p99_ms": 50.0,
    "event_p95_ms": 100.0,
    "pixel_p95_ms": 500.0,
    "cores_per_viewer": 0.3,
}


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


WATCH = """() => {
  window.seen = [];
  let before = null;
  const look = () => {
    const empty = document.body.innerText.includes('Nobody has requested anything.');
    if (empty === before) { return; }
    before = empty;
    requestAnimationFrame(() => requestAnimationFrame(() => window.seen.push(Date.now() / 1000)));
  };
  new MutationObserver(look).observe(document.body,
    {subtree: true, childList: true, characterData: true});
  look();
}"""
"""In the page: when it was painted that the first request is there, or the last one gone."""


def watch_screens(cell: Cell, viewers: int, gtin: str) -> tuple[list[float], float]:
    """What viewers see while a case is asked for and not wanted any more, again and again.

    Returns:
        From the command to its sight on each screen [s]; and the share of a core that each viewer
        costs the server.
    """
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - only here

    alone = _cores(cell, lambda: time.sleep(0.5), QUIET)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=CHROMIUM)
        context = browser.new_context(viewport={"width": 1280, "height": 800}, locale="en-GB")
        secret = cell.cookies["depal"]
        context.add_cookies([{"name": "depal", "value": secret, "url": cell.base}])
        pages = [context.new_page() for _ in range(viewers)]
        for page in pages:
            page.goto(cell.base)
            page.wait_for_timeout(2000)
            page.evaluate(WATCH)
        cores = _cores(cell, lambda: pages[0].wait_for_timeout(500), QUIET)
        ages: list[float] = []
        for _ in range(CYCLES):
            key = ""
            for step in ("POST", "DELETE"):
                known = [len(page.evaluate("() => window.seen")) for page in pages]
                asked = time.time()
                if step == "POST":
                    key = cell("POST", "/requests", json={"gtin": gtin, "priority": 0.0})["key"]
                else:
                    cell("DELETE", f"/requests/{key}", headers={"if-match": "*"})
                pages[0].wait_for_timeout(1000)
                for page, count in zip(pages, known, strict=True):
                    ages += [at - asked for at in page.evaluate("() => window.seen")[count:]]
        browser.close()
    return ages, max(cores - alone, 0.0) / viewers


QUIET, CYCLES = 20.0, 15
"""So long the server's work is measured [s]; so often a case is asked for."""


def _cores(cell: Cell, wait: Callable[[], None], seconds: float) -> float:
    """How many cores the server keeps busy, over some time."""
    path = Path(f"/proc/{cell.process.pid}/stat")

    def busy() -> float:
        fields = path.read_text(encoding="ascii").rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    before, began = busy(), time.monotonic()
    while time.monotonic() < began + seconds:
        wait()
    return (busy() - before) / (time.monotonic() - began)


CHROMIUM = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
]  # fmt: skip


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--delivery", default="dev-035")
    parser.add_argument("--perception", default="camera")
    parser.add_argument("--viewers", type=int, default=0)
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cell = Cell(Path(folder) / "data", 1.0, asked.perception)
        code = cell.link.split("code=")[1]
        cell("POST", "/first-account", json={"code": code, "name": NAME, "password": PASSWORD})
        document = document_of(read_delivery(asked.delivery))
        cell("POST", "/deliveries", json=document)
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
        painted, share = [], 0.0
        if asked.viewers:
            gtin = document["lines"][-1]["gtin"]
            painted, share = watch_screens(cell, asked.viewers, gtin)
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
    if painted:
        figures |= {
            "pixel_p50_ms": 1000 * float(np.percentile(painted, 50)),
            "pixel_p95_ms": 1000 * float(np.percentile(painted, 95)),
            "painted": len(painted),
            "cores_per_viewer": share,
        }
    Console().print_json(json.dumps(figures))
    if asked.json is not None:
        asked.json.write_text(json.dumps(figures), encoding="utf-8")
    return int(any(figures.get(name, 0.0) > target for name, target in TARGETS.items()))


if __name__ == "__main__":
    sys.exit(main())
