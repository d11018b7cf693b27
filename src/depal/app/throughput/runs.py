"""The runs of the study, in worker processes."""

from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path

from depal.app.files import Json, finite
from depal.app.run.job import run_job
from depal.app.run.summary import run_report
from depal.app.run.values import Job
from depal.app.throughput.asked import Asked
from depal.app.throughput.row import Row
from depal.studies.kept import Kept
from depal.studies.sweep import Progress, no_progress, sweep


@dataclass(frozen=True, slots=True)
class Failure:
    """A run that came to no end.

    Attributes:
        delivery: its id.
        seed: of the run.
        reason: what was wrong.
    """

    delivery: str
    seed: int
    reason: str


@dataclass(frozen=True, slots=True)
class Throughput:
    """What came of the study.

    Attributes:
        rows: the runs, delivery by delivery.
        failures: the runs that came to no end.
        resumed: how many rows had been kept before.
    """

    rows: tuple[Row, ...]
    failures: tuple[Failure, ...]
    resumed: int

    @property
    def holds(self) -> bool:
        """Whether every run ended with nothing lost, hit or booked wrongly."""
        return bool(self.rows) and not self.failures and all(row.holds for row in self.rows)


def throughput(
    asked: Asked,
    keep: Path | None = None,
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> Throughput:
    """Runs every delivery with every seed.

    Args:
        asked: the options.
        keep: a folder for finished runs; those that it has already are not run again.
        executor: where the runs are done; None for this process.
        progress: told how many boxes of how many are done.

    Raises:
        InputError: something cannot be used; nothing has run.
    """
    jobs = asked.jobs()
    kept = kept_rows(keep)
    done: dict[int, Row | Failure] = {
        number: row for number, job in enumerate(jobs) if (row := kept.get(job)) is not None
    }
    resumed = len(done)
    boxes = [len(job.delivery.boxes) for job in jobs]
    # The longest first: no worker is left alone with a long one at the end.
    todo = sorted(set(range(len(jobs))) - set(done), key=lambda number: (-boxes[number], number))

    def tell() -> None:
        progress(sum(boxes[number] for number in done), sum(boxes))

    def heard(piece: int, ran: dict[str, Json] | str) -> None:
        number = todo[piece]
        job = jobs[number]
        if isinstance(ran, str):
            done[number] = Failure(job.delivery.id, job.seed, ran)
        else:
            done[number] = row = Row.of(ran)
            kept.keep(job, row)
        tell()

    tell()
    sweep(run_one, [jobs[number] for number in todo], executor, heard=heard)
    ends = [done[number] for number in range(len(jobs))]
    return Throughput(
        tuple(end for end in ends if isinstance(end, Row)),
        tuple(end for end in ends if isinstance(end, Failure)),
        resumed,
    )


def kept_rows(folder: Path | None) -> Kept[Job, Row]:
    """The finished runs of a folder.

    Raises:
        SettingError: it cannot be made.
    """
    return Kept(folder, lambda job: f"{job.delivery.id}-{job.seed}", Row.of, lambda row: row.fields)


def run_one(job: Job) -> dict[str, Json] | str:
    """One run, in whatever process: the fields of `depal run --json`, or what went wrong.

    A run that breaks down is a result of the study: the others go on.
    """
    try:
        fields = run_report(run_job(job), job.perception).fields
    except Exception as error:  # noqa: BLE001 - whatever it is, it is what we report
        return f"{type(error).__name__}: {error}"
    return {name: finite(value) for name, value in fields.items()}
