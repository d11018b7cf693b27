"""What a study of throughput is asked for, and the runs that it consists of."""

from dataclasses import dataclass

from depal.app.run.inputs import cell_of, one_of, policy_of, refuse_what_cannot_work
from depal.app.run.values import PERCEPTIONS, TRUTH, Job
from depal.app.unload import deliveries_of
from depal.cell.workplace import Policy, Settings
from depal.domain import checked_share
from depal.errors import SettingError
from depal.logistics.store import random_requests
from depal.simulation.imaging.severity import Severity


@dataclass(frozen=True, slots=True)
class Asked:
    """The options of the study.

    Attributes:
        deliveries: a file of deliveries, FILE#ID, or "" for those that ship.
        cell: a cell file or the name of one that ships.
        w: the weight of Eq. (3).
        requests: so many random requests for each delivery.
        seeds: each delivery is run so often, each time with the next seed.
        seed: the first one.
        perception: where boxes come from: camera or truth.
        severity: how far cameras and boxes are from ideal.
        policy: which boxes may be taken.
    """

    deliveries: str = ""
    cell: str = "default"
    w: float = 0.5
    requests: int = 3
    seeds: int = 1
    seed: int = 0
    perception: str = TRUTH
    severity: str = Severity.NORMAL.value
    policy: str = Policy.PAPER.value

    def jobs(self) -> list[Job]:
        """Every run, delivery by delivery.

        Raises:
            InputError: something cannot be used; nothing has run.
        """
        settings = Settings(w=checked_share("--w", self.w), policy=policy_of(self.policy))
        for option, number, least in (
            ("--seeds", self.seeds, 1),
            ("--requests-per-delivery", self.requests, 0),
        ):
            if number < least:
                raise SettingError(option, f"{number} is out of range", f"{least} or more")
        perception = one_of("--perception", self.perception, PERCEPTIONS)
        names = [each.value for each in Severity]
        severity = Severity(one_of("--severity", self.severity, names))
        layout = cell_of(self.cell)
        deliveries = deliveries_of(self.deliveries)
        for delivery in deliveries:
            refuse_what_cannot_work(layout, delivery)
        return [
            Job(
                layout,
                delivery,
                random_requests(delivery, self.requests, seed),
                settings,
                seed,
                perception=perception,
                severity=severity,
            )
            for delivery in deliveries
            for seed in range(self.seed, self.seed + self.seeds)
        ]
