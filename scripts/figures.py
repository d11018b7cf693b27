"""Measures every figure, and prints the table that the README quotes.

    python scripts/figures.py [--fresh]

Each measurement is kept in .figures/ under the state of the sources that it was made with, so
an interrupted run goes on where it stopped; --fresh measures everything anew. The table is
printed and written between the two marks in README.md.
"""

import hashlib
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import track

ROOT = Path(__file__).resolve().parent.parent
BIN = Path(sys.executable).parent
KEPT = ROOT / ".figures"
BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"


@dataclass(frozen=True)
class Line:
    """One line of the table."""

    what: str
    figure: str
    measured: str
    met: bool


def depal(*words: str, env: dict[str, str] | None = None) -> tuple[dict[str, object], float]:
    """The JSON of a command, and the time that the whole process took [s]."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        start = time.perf_counter()
        command = [str(BIN / "depal"), *words, "--json", str(report)]
        done = subprocess.run(  # noqa: S603 - our own command
            command, capture_output=True, text=True, check=False, env={**os.environ, **(env or {})}
        )
        seconds = time.perf_counter() - start
        if not report.exists():
            raise SystemExit(f"{' '.join(words)} failed:\n{done.stdout}\n{done.stderr}")
        return json.loads(report.read_text(encoding="utf-8")), seconds


def table1() -> Iterator[Line]:
    """The table at full size, twice: at the default seed from nothing compiled, at another."""
    with tempfile.TemporaryDirectory() as cache:
        report, seconds = depal("study", "table1", env={"NUMBA_CACHE_DIR": cache})
    yield _checked("Table I, 10,000 pallets, default seed: conditions that hold", report)
    yield Line(
        "the same from the shell, compilation included",
        "<= 20 s",
        f"{seconds:.1f} s",
        seconds <= 20,  # noqa: PLR2004 - the figure
    )
    report, _ = depal("study", "table1", "--seed", "1")
    yield _checked("Table I, 10,000 pallets, seed 1: conditions that hold", report)


def _checked(what: str, report: dict[str, object]) -> Line:
    checks = report["checks"]
    assert isinstance(checks, list)  # noqa: S101 - our own file
    holding = sum(check["holds"] for check in checks)
    return Line(what, "all", f"{holding} of {len(checks)}", holding == len(checks))


def selection() -> Iterator[Line]:
    """`depal bench selection`."""
    yield from _benched("selection")


def executive() -> Iterator[Line]:
    """`depal bench executive`."""
    yield from _benched("executive")


def planning() -> Iterator[Line]:
    """`depal bench planning`."""
    yield from _benched("planning")


def simulation() -> Iterator[Line]:
    """`depal bench simulation`, whole runs included: a real delivery twice, the paper's case."""
    yield from _benched("simulation")


def perception_normal() -> Iterator[Line]:
    """`depal bench perception`: at least 3,000 known and 600 unknown boxes; times; real frames.

    Folders of real frames with masks, where there are any, are named in DEPAL_FRAMES with the
    system's path separator between them; none ships.
    """
    folders = [path for path in os.environ.get("DEPAL_FRAMES", "").split(os.pathsep) if path]
    real = [word for folder in folders for word in ("--frames", folder)]
    words = ("--severity", "normal", "--scenes", "330", "--workers", "2")
    yield from _benched("perception", *words, *real)


def perception_hard() -> Iterator[Line]:
    """`depal bench perception` on hard scenes, where detection alone has targets."""
    words = ("--severity", "hard", "--scenes", "201", "--workers", "2")
    for line in _benched("perception", *words):
        if line.what.startswith("hard") and line.figure:
            yield line


def _benched(part: str, *words: str) -> Iterator[Line]:
    report, _ = depal("bench", part, *words)
    figures = report["figures"]
    assert isinstance(figures, list)  # noqa: S101 - our own file
    for figure in figures:
        yield _line_of(figure)


def _line_of(figure: dict[str, Any]) -> Line:
    """A figure of `depal bench`; null is what could not be measured, or has no target."""
    value, target, unit = figure["value"], figure["target"], figure["unit"]
    peers = ", ".join(f"{name}: {peer:.4g}" for name, peer in figure["peers"].items())
    said = "not measured" if value is None else f"{value:.4g} {unit}".rstrip()
    said += f" ({peers})" if peers else ""
    if target is None:
        return Line(figure["name"], "", said, value is not None)
    lower = figure["better"] == "lower"
    met = value is not None and (value <= target if lower else value >= target)
    aim = f"{'<=' if lower else '>='} {target:g} {unit}".rstrip()
    return Line(figure["name"], aim, said, met)


def throughput() -> Iterator[Line]:
    """`depal study throughput` over the deliveries that ship; finished runs are kept."""
    kept = str(KEPT / f"throughput-{state()}")
    report, _ = depal("study", "throughput", "--workers", "2", "--keep", kept)
    total: dict[str, Any] = report["summary"]  # type: ignore[assignment]
    runs = f"{total['runs']} real deliveries in the cell"
    failures = report["failures"]
    assert isinstance(failures, list)  # noqa: S101 - our own file
    yield Line(f"{runs}: runs without an end", "0", str(len(failures)), not failures)
    share = total["stored_share"] or 0.0
    stored = f"{100 * share:.1f} % ({total['stored']} of {total['boxes']})"
    yield Line(f"{runs}: boxes stored", ">= 99 %", stored, share >= 0.99)  # noqa: PLR2004
    counts = [total[name] for name in ("lost", "collisions", "disagreements", "placed_twice")]
    yield Line(
        f"{runs}: lost; collisions; not where the books say; placed twice",
        "0; 0; 0; 0",
        "; ".join(map(str, counts)),
        not any(counts),
    )
    rate = total["boxes_per_hour"]["median"] or 0.0
    yield Line(f"{runs}: median rate", ">= 400 boxes/h", f"{rate:.0f} boxes/h", rate >= 400)  # noqa: PLR2004
    shares = ", ".join(f"{name} {100 * part:.1f} %" for name, part in total["shares"].items())
    yield Line(f"{runs}: where the time goes", "", shares, met=True)
    plan = total["plan_seconds"]
    for name, key, target in (("median", "median", 30.0), ("95th percentile", "p95", 200.0)):
        spent = 1e3 * plan[key] if plan[key] is not None else float("inf")
        said = f"{spent:.1f} ms"
        yield Line(f"{runs}: planning a motion, {name}", f"<= {target:g} ms", said, spent <= target)


def with_camera() -> Iterator[Line]:
    """The same deliveries seen by the cameras; finished runs are kept."""
    kept = str(KEPT / f"camera-{state()}")
    words = ("--perception", "camera", "--workers", "1", "--keep", kept)
    report, _ = depal("study", "throughput", *words)
    total: dict[str, Any] = report["summary"]  # type: ignore[assignment]
    runs = f"{total['runs']} real deliveries with the camera"
    share = total["stored_share"] or 0.0
    stored = f"{100 * share:.1f} % ({total['stored']} of {total['boxes']})"
    yield Line(f"{runs}: boxes stored", ">= 97 %", stored, share >= 0.97)  # noqa: PLR2004
    counts = [total[name] for name in ("lost", "collisions", "disagreements", "placed_twice")]
    what = f"{runs}: lost; collisions; not where the books say; placed twice"
    yield Line(what, "0; 0; 0; 0", "; ".join(map(str, counts)), not any(counts))


def faults() -> Iterator[Line]:
    """`depal study faults`: each fault 100 times, 2,000 pairs; finished runs are kept."""
    kept = str(KEPT / f"faults-{state()}")
    words = ("--seeds", "100", "--pairs", "2000", "--workers", "2", "--keep", kept)
    report, _ = depal("study", "faults", *words)
    rows: list[dict[str, Any]] = report["rows"]  # type: ignore[assignment]
    each = f"{len(rows)} faults, 100 runs each"
    for what, name in (("ends as named", "ended"), ("invariants hold", "invariants")):
        worst = min(rows, key=lambda row: row[name])
        said = f"{100 * worst[name]:.0f} % ({worst['fault']})"
        yield Line(f"{each}: {what}, the worst", "100 %", said, worst[name] == 1.0)
    pairs: dict[str, Any] = report["pairs"]  # type: ignore[assignment]
    broken = len(pairs["broken"])
    yield Line(f"{pairs['n']} pairs: an invariant broken", "0", str(broken), not broken)
    spent: float = report["recovery"]["p95"]  # type: ignore[index]
    what = "recovery, the software's part, 95th percentile"
    yield Line(what, "<= 5 s", f"{spent:.2g} s", spent <= 5)  # noqa: PLR2004


def storm() -> Iterator[Line]:
    """`depal study faults --cuts --shift`, in light worlds, and a shift with physics."""
    kept = str(KEPT / f"storm-{state()}")
    many = ("--cuts", "10000", "--shift", "100000")
    words = ("--seeds", "0", "--workers", "2", "--keep", kept)
    report, _ = depal("study", "faults", *words, *many)
    cuts: dict[str, Any] = report["cuts"]  # type: ignore[assignment]
    for name, what in (
        ("positions", "a cut at every write of ten boxes"),
        ("random", "cuts at random moments"),
    ):
        yield _storm_line(f"{cuts[name]['cuts']} cuts: {what}", cuts[name])
    control = cuts["control"]
    bad = control["lost"] + control["doubled"] + control["misplaced"]
    yield Line("the control, which runs begun steps again: boxes wrong", "> 0", str(bad), bad > 0)
    shift: dict[str, Any] = report["shift"]  # type: ignore[assignment]
    yield _storm_line(f"a shift of {shift['boxes']} boxes in light worlds", shift)
    report, _ = depal("study", "faults", *words, "--shift", "1000", "--world", "physics")
    done: dict[str, Any] = report["shift_physics"]  # type: ignore[assignment]
    said = f"{done['lost']}; {len(done['wrong'])}"
    what = f"a shift of {done['boxes']} boxes with physics: lost; otherwise wrong"
    yield Line(what, "0; 0", said, said == "0; 0")


def _storm_line(what: str, found: dict[str, Any]) -> Line:
    counts = [found[name] for name in ("lost", "doubled", "misplaced")]
    said = "; ".join(map(str, counts))
    good = not any(counts) and not found["wrong"]
    return Line(f"{what}: lost; doubled; misplaced", "0; 0; 0", said, good)


def crashes() -> Iterator[Line]:
    """Crashes at random events of runs with failing primitives, and after every single one."""
    tests = "tests/executive/test_runtime.py"
    done = subprocess.run(  # noqa: S603 - our own command
        [BIN / "pytest", "-q", tests, "-k", "crash"],
        cwd=ROOT, check=False, capture_output=True, text=True,
        env={**os.environ, "DEPAL_CRASHES": "10000"},
    )  # fmt: skip
    good = done.returncode == 0
    yield Line(
        "two stores, 10,000 runs with up to 4 crashes, and a crash after every event",
        "same facts, no motion twice",
        "held in all" if good else "BROKEN: see pytest -k crash",
        good,
    )


def case2() -> Iterator[Line]:
    """`depal study case2`, with many draws."""
    report, _ = depal("study", "case2", "--draws", "2000")
    layouts = report["layouts"]
    assert isinstance(layouts, list)  # noqa: S101 - our own file
    for entry in layouts:
        ranks = f"{entry['without']}th / {entry['with']}th"
        yield Line(
            f"case study 2, {entry['layout']}: b1 without / with the request; under jitter",
            "10th / 8th; >= 95 %",
            f"{ranks}; {100 * entry['robust']:.1f} %",
            (entry["without"], entry["with"]) == (10, 8) and entry["robust"] >= 0.95,  # noqa: PLR2004
        )


def stability() -> Iterator[Line]:
    """`depal study stability`, at a seed that took no part in choosing its settings."""
    report, _ = depal("study", "stability", "--seed", "2", "--workers", "2")
    checks = report["checks"]
    assert isinstance(checks, list)  # noqa: S101 - our own file
    for check in checks:
        yield Line(check["name"], check["allowed"], check["measured"], check["holds"])


def retrieval() -> Iterator[Line]:
    """`depal study retrieval`: removals of both policies beside their proven minimum."""
    words = ("study", "retrieval", "--workers", "2", "--referee", "300")
    full = ("--pallets", "10000", "--cell-pallets", "300")
    kinds = "layered,cubic,columns,dropped"
    others = ("--generators", kinds, "--pallets", "1000", "--cell-pallets", "0")
    for report, _ in (depal(*words, *full), depal(*words, *others, "--deliveries", "dev-035")):
        for check in report["checks"]:  # type: ignore[attr-defined]
            yield Line(check["name"], check["allowed"], check["measured"], check["holds"])
        for paper, access in _pairs(report["rows"]):
            said = ", ".join(
                f"{row['policy']} {row['actions']['mean']:.2f} (minimum {row['limit']:.2f})"
                for row in (paper, access)
            )
            where = ", with clearance and reach" if paper["clearance"] else ""
            name = f"{paper['pallets']}, {paper['side_only']:.0%} side-only{where}: actions"
            better = access["actions"]["mean"] <= paper["actions"]["mean"]
            yield Line(name, "access <= paper", said, better)


def _pairs(rows: object) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
    """Rows two by two."""
    assert isinstance(rows, list)  # noqa: S101 - our own file
    yield from zip(rows[::2], rows[1::2], strict=True)


def in_the_cell() -> Iterator[Line]:
    """Both policies over the deliveries that ship, with physics: as safe, and sooner."""
    runs = {}
    for policy in ("paper", "access"):
        kept = str(KEPT / f"{policy}-{state()}")
        words = ("--policy", policy, "--workers", "2", "--keep", kept)
        runs[policy], _ = depal("study", "throughput", *words)
    before = {
        policy: [
            wish["boxes_before"] if wish["served"] is not None else None
            for row in report["rows"]  # type: ignore[attr-defined]
            for wish in row["requests"]
        ]
        for policy, report in runs.items()
    }
    both = [
        (paper, access)
        for paper, access in zip(before["paper"], before["access"], strict=True)
        if paper is not None and access is not None
    ]
    saved = statistics.mean(paper - access for paper, access in both)
    error = statistics.stdev(paper - access for paper, access in both) / len(both) ** 0.5
    total: dict[str, Any] = runs["access"]["summary"]  # type: ignore[assignment]
    counts = [total[name] for name in ("lost", "collisions", "disagreements", "placed_twice")]
    yield Line(
        f"--policy access, {total['runs']} real deliveries: lost; collisions; books; placed twice",
        "0; 0; 0; 0",
        "; ".join(map(str, counts)),
        not any(counts),
    )
    yield Line(
        f"boxes before a request that access saves in the cell ({len(both)} requests, paired)",
        "> 0",
        f"{saved:.2f} +- {1.96 * error:.2f}",
        saved > 0,
    )


def unloading() -> Iterator[Line]:
    """`depal study unload` over the deliveries that ship."""
    report, _ = depal("study", "unload")
    deliveries = report["deliveries"]
    assert isinstance(deliveries, list)  # noqa: S101 - our own file
    boxes = sum(entry["boxes"] for entry in deliveries)
    taken = sum(entry["taken"] for entry in deliveries)
    burdened = sum(len(entry["burdened"]) for entry in deliveries)
    yield Line(
        f"{len(deliveries)} real deliveries on geometry alone: boxes taken; with a box on them",
        f"{boxes} of {boxes}; 0",
        f"{taken} of {boxes}; {burdened}",
        taken == boxes and not burdened,
    )


def due() -> Iterator[Line]:
    """`depal study due`: lateness by the paper's rule and by the agenda, and the exact optimum."""
    report, _ = depal(
        "study", "due", "--pallets", "1000", "--small", "300", "--workers", "2"
    )  # fmt: skip
    rows = report["due"]
    assert isinstance(rows, list)  # noqa: S101 - our own file
    for row in rows:
        if row["policy"] != "agenda":
            continue
        kind = f"{row['pallets']}, {row['side_only']:.0%} side-only, arrivals: {row['arrivals']}"
        low, high = row["saved"]["ci95"]
        what = (
            f"weighted lateness saved against the paper's rule, {row['requests']} pallets ({kind})"
        )
        yield Line(what, "> 0 (95 %)", f"{low:.2f} .. {high:.2f} actions", low > 0)
        if row["above"] is not None:
            above = f"{100 * row['above']:.2f} %"
            what = f"the same, <= 10 boxes ({kind}): above the exact optimum"
            yield Line(what, "<= 5 %", above, row["above"] <= 0.05)  # noqa: PLR2004 - the figure


def learning() -> Iterator[Line]:
    """`depal study learning`: a known policy recovered from 200 of its orders, 20 times."""
    for temperature in ("0.01", "0.03"):
        words = ("--pallets", "200", "--seeds", "20", "--temperature", temperature)
        report, _ = depal("study", "learning", *words, "--workers", "2")
        rows = report["rows"]
        assert isinstance(rows, list)  # noqa: S101 - our own file
        worst = max(row["greatest_error"] for row in rows)
        often = f"all four in {report['recovered']} of {report['of']}"
        followed = f"{100 * float(str(report['followed'])):.0f} % of choices the best"
        at_target = temperature == "0.01"
        yield Line(
            f"weights of a policy from 200 recorded pallets, T = {temperature} m ({followed})",
            "within 5 %" if at_target else "",
            f"greatest error {100 * worst:.1f} %; {often}",
            worst <= 0.05 or not at_target,  # noqa: PLR2004 - the figure
        )


def hidden() -> Iterator[Line]:
    """`depal study hidden`: a requested box that nobody has seen."""
    report, _ = depal("study", "hidden", "--pallets", "250", "--workers", "2")
    rows = report["hidden"]
    assert isinstance(rows, list)  # noqa: S101 - our own file
    for row in rows:
        if row["policy"] != "searches":
            continue
        low, high = row["saved"]["ci95"]
        what = f"unseen box ({row['pallets']}, {row['requests']} pallets): removals saved"
        said = f"{low:.2f} .. {high:.2f} ({row['actions']['mean']:.2f} left)"
        yield Line(what, "> 0 (95 %)", said, low > 0)
        share = row["region"]["mean"]
        within = 0.75 <= share <= 0.85 or row["pallets"] != "all"  # noqa: PLR2004 - the figure
        what = f"unseen box ({row['pallets']}): the 80 % belief region holds it"
        aim = "75-85 %" if row["pallets"] == "all" else ""
        yield Line(what, aim, f"{100 * share:.1f} %", within)


def tests() -> Iterator[Line]:
    """The unit tests' time, and the branches of the core."""
    start = time.perf_counter()
    subprocess.run(  # noqa: S603 - our own command
        [BIN / "pytest", "-q", "-n", "2", "-m", "not slow"],
        cwd=ROOT,
        check=True,
        capture_output=True,
    )
    seconds = time.perf_counter() - start
    yield Line("unit tests, 2 processes", "< 120 s", f"{seconds:.0f} s", seconds < 120)  # noqa: PLR2004
    done = subprocess.run(  # noqa: S603 - our own command
        [
            BIN / "pytest", "-q", "tests/domain", "tests/geometry", "tests/selection",
            "--cov=depal.domain", "--cov=depal.geometry", "--cov=depal.selection", "--cov-branch",
        ],
        cwd=ROOT, check=True, capture_output=True, text=True,
        env={**os.environ, "NUMBA_DISABLE_JIT": "1"},
    )  # fmt: skip
    share = re.search(r"^TOTAL.*?(\d+)%", done.stdout, re.MULTILINE)
    percent = int(share[1]) if share else 0
    yield Line(
        "branch coverage of domain, geometry, selection (compiler off)",
        "100 %",
        f"{percent} %",
        percent == 100,  # noqa: PLR2004
    )


def script(name: str, *words: str) -> tuple[bool, str]:
    """Runs a script beside this one: whether it was content, and its last words."""
    done = subprocess.run(  # noqa: S603 - our own script
        [sys.executable, str(ROOT / "scripts" / name), *words],
        cwd=ROOT, check=False, capture_output=True, text=True,
    )  # fmt: skip
    told = " ".join(done.stdout.split("\n\n")[-1].split())
    return done.returncode == 0, told[-300:] or done.stderr[-300:]


def api() -> Iterator[Line]:
    """`scripts/fuzz_api.py`: 20,000 generated requests."""
    good, told = script("fuzz_api.py", "--requests", "20000", "--seed", "1")
    figure = "0 server errors, 0 hangs, 2xx >= 20 each"
    yield Line("20,000 generated requests to the API", figure, told.split("┘")[-1].strip(), good)


def kills() -> Iterator[Line]:
    """`scripts/kill_cell.py`: the controller killed 200 times."""
    good, told = script("kill_cell.py", "--kills", "200")
    what = "kill -9 of the controller, the world lives on"
    yield Line(what, "nothing lost, doubled or booked wrongly", told, good)


def served() -> Iterator[Line]:
    """`scripts/measure_serve.py`: beside the simulation, with the camera."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "served.json"
        script("measure_serve.py", "--seconds", "60", "--viewers", "2", "--json", str(path))
        found: dict[str, float] = json.loads(path.read_text(encoding="utf-8"))
    for what, name, target, unit in (
        ("GET state at 50/s, p99", "state_p99_ms", 50.0, "ms"),
        ("event to socket, p95", "event_p95_ms", 100.0, "ms"),
        ("command to pixel, p95", "pixel_p95_ms", 500.0, "ms"),
        ("server, per viewer", "cores_per_viewer", 0.3, "cores"),
    ):
        value = found[name]
        said = f"{value:.3g} {unit}"
        yield Line(f"a served cell: {what}", f"<= {target:g} {unit}", said, value <= target)


MEASUREMENTS: tuple[Callable[[], Iterator[Line]], ...] = (
    table1,
    selection,
    case2,
    retrieval,
    stability,
    unloading,
    due,
    hidden,
    learning,
    executive,
    crashes,
    planning,
    simulation,
    perception_normal,
    perception_hard,
    throughput,
    with_camera,
    faults,
    storm,
    api,
    kills,
    served,
    in_the_cell,
    tests,
)


def state() -> str:
    """A hash of the sources and what ships with them, the tests and this script."""
    digest = hashlib.sha256(Path(__file__).read_bytes())
    for folder in ("src", "tests"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in {".py", ".task", ".yaml", ".json"}:
                digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def measured(measure: Callable[[], Iterator[Line]], *, fresh: bool) -> list[Line]:
    """The lines of a measurement, kept or made now."""
    kept = KEPT / f"{measure.__name__}-{state()}.json"
    if fresh or not kept.exists():
        KEPT.mkdir(exist_ok=True)
        kept.write_text(json.dumps([asdict(line) for line in measure()]), encoding="utf-8")
    return [Line(**entry) for entry in json.loads(kept.read_text(encoding="utf-8"))]


def main() -> int:
    """Measures, prints, writes the README; exit status 1 where a figure is missed."""
    fresh = "--fresh" in sys.argv
    console = Console(stderr=True)
    lines: list[Line] = []
    for measure in track(MEASUREMENTS, "Figures", console=console, transient=True):
        lines += measured(measure, fresh=fresh)
    rows = ["| figure | target | measured | |", "|---|---|---|---|"]
    rows += [
        f"| {line.what} | {line.figure} | {line.measured} | {'met' if line.met else 'MISSED'} |"
        for line in lines
    ]
    table = "\n".join(rows)
    print(table)
    readme = ROOT / "README.md"
    text = readme.read_text(encoding="utf-8")
    if BEGIN in text and END in text:
        head, tail = text.split(BEGIN)[0], text.split(END)[1]
        readme.write_text(f"{head}{BEGIN}\n{table}\n{END}{tail}", encoding="utf-8")
    return 0 if all(line.met for line in lines) else 1


if __name__ == "__main__":
    sys.exit(main())
