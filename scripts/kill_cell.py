"""`kill -9` of the controller at random moments; the world lives on, and the run goes on in it.

    python scripts/kill_cell.py --kills 200

Runs of a real delivery under `depal serve`, in real processes and faster than real time. After
every kill the cell must be Held, look, and go on after Start. At the end the referee is asked: no
box lost or placed twice, every request ended once, the stock as it is.
"""

import argparse
import asyncio
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx2
from rich.console import Console
from rich.progress import Progress

from depal.drivers.remote import connect
from depal.drivers.remote.finding import card_of
from depal.executive.clock import run_paced
from depal.logistics import read_delivery
from depal.ports.wire.messages import Truth
from depal.server.records.documents import document_of

NAME, PASSWORD = "anna", "ten letters at least"

PER_RUN = 10
"""So often a run is killed: about as often as its moments fit into it."""

PATIENCE = 600.0
"""A run that is not over by then hangs [s]."""


@dataclass
class Tally:
    """What came of the kills."""

    kills: int = 0
    runs: int = 0
    boxes: int = 0
    stored: int = 0
    taken: int = 0
    questions: int = 0
    found: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)


class Cell:
    """A served cell and a client of it."""

    def __init__(self, data: Path, pace: float, perception: str) -> None:
        """Starts it."""
        self.data = data
        command = str(Path(sys.executable).with_name("depal"))
        self._command = [
            command, "serve", "--data", str(data), "--port", "0",
            "--perception", perception, "--pace", str(pace),
        ]  # fmt: skip
        self.link = self._up()
        self._client = httpx2.Client(timeout=60.0)

    def _up(self) -> str:
        self.process = subprocess.Popen(  # noqa: S603 - our own command
            self._command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        line = self.process.stdout.readline() if self.process.stdout is not None else ""
        if "http" not in line:
            _, rest = line, self.process.communicate()[0]
            raise RuntimeError(f"the cell did not start: {line}{rest}")
        self.link = line.split(": ", 1)[1].strip()
        self.base = "/".join(self.link.split("/")[:3])
        return self.link

    @property
    def cookies(self) -> httpx2.Cookies:
        """Of whoever is signed in."""
        return self._client.cookies

    def kill(self) -> None:
        """As nobody could prevent; then it is started anew."""
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        self._up()
        self("POST", "/sign-in", json={"name": NAME, "password": PASSWORD})

    def __call__(self, method: str, path: str, **how: Any) -> Any:  # noqa: ANN401 - JSON
        """One call of the API."""
        headers = {"origin": self.base, **how.pop("headers", {})}
        response = self._client.request(method, f"{self.base}/api/v1{path}", headers=headers, **how)
        if response.status_code >= 300:  # noqa: PLR2004 - HTTP's own number
            raise RuntimeError(f"{method} {path}: {response.status_code} {response.text}")
        return response.json() if response.content else None

    def end(self) -> Truth:
        """Ends the controller; the referee has the last word."""
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        card = card_of(self.data)
        if card is None:
            raise RuntimeError("the world did not live on")
        return run_paced(_judged(self.data), card.pace)


async def _judged(data: Path) -> Truth:
    world = await connect(data, 0)
    truth = await world.referee.judge()
    await world.shutdown()
    await asyncio.sleep(0)
    return truth


def one_run(
    cell: Cell, delivery: str, kills: int, draw: random.Random, pace: float, tally: Tally
) -> None:
    """A delivery under so many kills, in a cell that has just been started."""
    code = cell.link.split("code=")[1]
    cell("POST", "/first-account", json={"code": code, "name": NAME, "password": PASSWORD})
    document = document_of(read_delivery(delivery))
    cell("POST", "/deliveries", json=document)
    cell("POST", "/commands/start", json={})
    wanted = [line["gtin"] for line in document["lines"][:3]]
    for gtin in wanted:
        cell("POST", "/requests", json={"gtin": gtin, "priority": draw.random()})
    _through(cell, kills, draw, pace, tally)
    _judge(cell, len(wanted), tally)


def _through(cell: Cell, kills: int, draw: random.Random, pace: float, tally: Tally) -> None:
    until, next_kill = time.monotonic() + PATIENCE, time.monotonic() + draw.uniform(0.5, 25 / pace)
    while time.monotonic() < until:
        if kills and time.monotonic() >= next_kill:
            cell.kill()
            kills, tally.kills = kills - 1, tally.kills + 1
            state = cell("GET", "/state")
            if state["mode"] == "held":
                tally.found[state["reason"].rsplit(": ", 1)[-1]] += 1
                cell("POST", "/commands/start", json={})
            elif state["mode"] != "complete":
                tally.wrong.append(f"after a kill the cell is {state['mode']}")
            next_kill = time.monotonic() + draw.uniform(0.5, 25 / pace)
        state = cell("GET", "/state")
        for question in state["questions"]:
            tally.questions += 1
            choice = {"choice": question["choices"][0]}
            cell("PUT", f"/answers/{question['id']}", json=choice)
        if state["mode"] == "complete":
            return
        time.sleep(0.1)
    tally.wrong.append(f"a run hangs: {cell('GET', '/state')['reason']}")


def _judge(cell: Cell, wanted: int, tally: Tally) -> None:
    run = cell("GET", "/runs/1")["result"]
    requests, stock = cell("GET", "/requests"), cell("GET", "/stock")
    truth = cell.end()
    tally.runs += 1
    sequence = run.get("sequence", [])
    tally.boxes += len(truth.where)
    tally.stored += sum(each["outcome"] == "stored" for each in sequence)
    tally.taken += sum(each["outcome"] == "taken by a person" for each in sequence)
    boxes = [each["box"] for each in sequence]
    wrong = []
    if len(set(boxes)) != len(boxes) or len(boxes) != len(truth.where):
        wrong.append(f"{len(truth.where)} boxes, and {len(boxes)} ends of {len(set(boxes))} names")
    booked: Counter[str] = Counter()
    for line in stock:
        booked[line["place"]] += line["count"]
    found = Counter(where for where in truth.where if "/" in where and "aside" not in where)
    if booked != found:
        wrong.append(f"the stock says {dict(booked)}, the referee {dict(found)}")
    if any(where in {"floor", "elsewhere", "pallet", "hand"} for where in truth.where):
        wrong.append(f"boxes are left: {Counter(truth.where)}")
    states = Counter(request["state"] for request in requests)
    if states["served"] != wanted or len(requests) != wanted:
        wrong.append(f"{wanted} requests, and they are {dict(states)}")
    wrong += truth.collisions
    tally.wrong += wrong


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--delivery", default="dev-035")
    parser.add_argument("--pace", type=float, default=10.0)
    parser.add_argument("--perception", default="truth")
    parser.add_argument("--keep", type=Path, help="the data of runs with something wrong")
    asked = parser.parse_args()
    draw, tally = random.Random(asked.seed), Tally()  # noqa: S311 - no secret
    console = Console()
    with Progress(console=console) as progress:
        bar = progress.add_task("Kills", total=asked.kills)
        while tally.kills < asked.kills:
            count = min(PER_RUN, asked.kills - tally.kills)
            before = tally.kills
            known = len(tally.wrong)
            with tempfile.TemporaryDirectory() as folder:
                data = Path(folder) / "data"
                cell = Cell(data, asked.pace, asked.perception)
                one_run(cell, asked.delivery, count, draw, asked.pace, tally)
                if asked.keep is not None and len(tally.wrong) > known:
                    kept = asked.keep / f"{asked.seed}-{tally.runs}"
                    shutil.copytree(data, kept, ignore=shutil.ignore_patterns("*.sock"))
            progress.advance(bar, tally.kills - before)
            for line in tally.wrong[known:]:
                console.print(line, style="red", markup=False)
            if not console.is_terminal:
                print(f"{tally.kills} of {asked.kills}", file=sys.stderr, flush=True)
            if tally.kills == before:
                break
    console.print(
        f"{tally.kills} kills in {tally.runs} runs: {tally.boxes} boxes, {tally.stored} stored, "
        f"{tally.taken} taken by a person, {tally.questions} questions; the sensors said "
        f"{dict(tally.found)}; {len(tally.wrong)} wrong"
    )
    return int(bool(tally.wrong) or tally.kills < asked.kills)


if __name__ == "__main__":
    sys.exit(main())
