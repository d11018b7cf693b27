"""How a held box is presented to the barcode reader."""

from dataclasses import replace

from depal.cell.planning.loads import load_of
from depal.cell.planning.planner import Planner
from depal.cell.planning.plans import Load, ShowPlan
from depal.cell.planning.promises import Promises
from depal.cell.planning.showing import shown_poses
from depal.cell.planning.wary import scenes_around
from depal.cell.rules import SHOWING, rules_on
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.motion.collision import Scene
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
        rules = rules_on(self._work.engine, box, SHOWING)
        bulky, before = replace(load.bulky, rules=rules), self._planner.planned
        plan: ShowPlan | str = ""
        for scene in scenes_around(bulky, self._work, self._promises):
            plan = self._sides(load, bulky, scene)
            if not isinstance(plan, str):
                break
        await self._planner.charge(min(self._planner.planned - before, 1))
        return plan

    def _sides(self, load: Load, bulky: Load, scene: Scene) -> ShowPlan | str:
        """One motion for each side of a box that can be shown.

        Args:
            load: the box.
            bulky: the same with the room that it may take, and what its task asks.
            scene: what it is kept out of.
        """
        planner = self._planner
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
        return bulky.rules.after(str(NoMotion.because(reasons or ["no side can be shown"])))
