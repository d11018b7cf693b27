"""How a held box is presented to the barcode reader."""

from dataclasses import replace

from depal.cell.planning.loads import load_of
from depal.cell.planning.planner import Planner
from depal.cell.planning.plans import Load, ShowPlan
from depal.cell.planning.promises import Promises
from depal.cell.planning.showing import shown_poses
from depal.cell.rules import SHOWING, rules_on
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.motion.moves import NoMotion
from depal.ports import Trajectory


class Presenting:
    """Plans the motions to the reader."""

    def __init__(self, work: Workplace, planner: Planner, promises: Promises) -> None:
        """Presents what is held."""
        self._work = work
        self._planner = planner
        self._promises = promises

    async def show(self, box: BoxId) -> ShowPlan | str:
        """The motions of a held box to the reader, one for each side that can be shown."""
        load = load_of(box, self._work, self._promises.pick_of(box))
        if load is None:
            return f"box {box} is not held"
        before = self._planner.planned
        plan = self._sides(load)
        await self._planner.charge(min(self._planner.planned - before, 1))
        return plan

    def _sides(self, load: Load) -> ShowPlan | str:
        planner = self._planner
        rules = rules_on(self._work.engine, load.box, SHOWING)
        scene = self._promises.scene(self._work.pile, load.box, rules.zones)
        bulky = replace(load.bulky, rules=rules)
        holding, clear = planner.holding(load), planner.checker(bulky, scene)
        found: list[Trajectory] = []
        reasons: list[str] = []
        for _, pose in shown_poses(load, self._work.layout.reader):
            parts = planner.show(bulky, pose, scene)
            if isinstance(parts, NoMotion):
                reasons += parts.reasons
                continue
            trajectory = planner.timing.along(parts, holding, clear, load.pace)
            if trajectory is None:
                continue
            found.append(trajectory)
            bulky = replace(bulky, lead=(), start=parts[-1].path[-1])
        if found:
            return ShowPlan(found[0], tuple(found[1:]))
        return rules.after(str(NoMotion.because(reasons or ["no side can be shown"])))
