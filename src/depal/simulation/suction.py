"""The gripper in the simulated world: valves, vacuum, and welds that give way."""

import mujoco
import numpy as np
import numpy.typing as npt

from depal.domain import Cup, Tool
from depal.domain.cup_group import CupGroup
from depal.simulation.holds import ROWS, TURN_SCALE, Broken, Hold, Valve
from depal.simulation.model import WELDS, CellModel
from depal.simulation.sealing import Solids, cups_in_cell, pressed, sealed

Floats = npt.NDArray[np.float64]

HOLDS = 0.8
"""A module holds its vacuum when its sensor reads this share of the full one."""

LEAK = 0.6
"""An open cup that seals nowhere costs the module as much as this share of a sealed one."""

IMPEDANCE = 0.5
"""Of the welds: with it a weld is a spring whose stiffness is the bellows' own."""

DAMPING = 0.3
"""Of a box on its bellows, as a share of the critical one."""

STIFFEST = 2e4
"""The greatest stiffness of a weld by mass that 2 ms steps follow [1/s^2]."""

BURST = 0.05
"""The vacuum of a torn module is gone after this [s]."""

TOUCH = 1e-9
"""A force that wakes a sleeping box and does nothing else [N]."""


class SuctionState:
    """Valves, vacuum and welds of the tool.

    Attributes:
        model: the world's.
        data: its state.
        tool: the gripper.
        folded: whether the lower module is up.
        open: the cups with open valves, by module.
        holds: what hangs on the tool, in the order of the welds.
        let_go: whether a box was let go since the last step.
        stuck: a fault: the valves do not vent.
        supply: a fault where it is below 1: share of the full vacuum that the pump gives.
    """

    def __init__(self, model: CellModel, data: mujoco.MjData) -> None:
        """All cups are vented, the lower module is down."""
        self.model, self.data = model, data
        self.tool: Tool = model.layout.tool
        self.folded = False
        self.open: dict[str, tuple[int, ...]] = {}
        self.holds: list[Hold] = []
        self.let_go = False
        self.stuck = False
        self.supply = 1.0
        self._valves = {module.name: Valve() for module in self.tool.modules}

    def vacuum(self, now: float) -> dict[str, float]:
        """Below the pressure around, by module [Pa]."""
        return {name: valve.level(now) for name, valve in self._valves.items()}

    def open_valves(self, cups: tuple[Cup, ...], now: float) -> None:
        """Opens the valves of these cups and shuts all others that hold nothing."""
        wanted = sorted(self._held_cups() | set(cups))
        names = [module.name for module in self.tool.modules]
        self.open = {name: tuple(cup for module, cup in wanted if module == name) for name in names}
        for name in names:
            cups_here = tuple((name, cup) for cup in self.open[name])
            good = int((self.boxes_under(cups_here) >= 0).sum())
            self._head_for(name, self._level(name, good), now, self.tool.suction.rise)

    def grip(self, now: float) -> bool:
        """Welds every sealed cup whose module has its vacuum; whether all open modules have it."""
        fresh = [
            (name, cup)
            for name, cups in self.open.items()
            for cup in cups
            if (name, cup) not in self._held_cups() and self._valves[name].level(now) > 0.0
        ]
        under = dict(zip(fresh, self.boxes_under(tuple(fresh)).tolist(), strict=True))
        for plane in self._planes():
            for box in sorted({under[cup] for cup in fresh if cup[0] in plane} - {-1}):
                self._weld(tuple(c for c in fresh if c[0] in plane and under[c] == box), box)
        full = HOLDS * self.tool.suction.vacuum
        opened = [name for name, cups in self.open.items() if cups]
        return bool(opened) and all(self._valves[name].level(now) >= full for name in opened)

    def vent(self, now: float) -> None:
        """Shuts every valve and lets go of every box."""
        if self.stuck:
            return
        for hold in list(self.holds):
            self._let_go(hold)
        self.open = {}
        for name in self._valves:
            self._head_for(name, 0.0, now, self.tool.suction.vent)

    def stick(self, box: int, to: int) -> None:
        """A fault: a box comes along with one that the cups hold."""
        cups = next(hold.cups for hold in self.holds if hold.box == to)
        self._weld(cups, box)

    def detach(self, box: int, now: float) -> None:
        """Pulls a box off the cups; they leak from now on."""
        for hold in [hold for hold in self.holds if hold.box == box]:
            self._tear(hold, now)

    def after_step(self, now: float) -> list[Broken]:
        """Reads the load of every hold; those beyond their limit break."""
        broken = []
        data, bodies = self.data, self.model.box_bodies
        tool = data.xmat[self.model.tool_body].reshape(3, 3)
        for k, hold in enumerate(self.holds):
            if data.ne >= ROWS * (k + 1):
                forces = data.efc_force[ROWS * k : ROWS * (k + 1)]
                hold.read(forces, tool, data.xmat[bodies[hold.box]].reshape(3, 3))
            share, why = hold.group.load_share(hold.force, hold.moment, self._pull(hold, now))
            if share > 1.0:
                broken.append((hold, Broken(now, hold.box, why, share)))
        for hold, _ in broken:
            self._tear(hold, now)
        return [event for _, event in broken]

    @property
    def held_boxes(self) -> tuple[int, ...]:
        """The boxes that hang on the tool."""
        return tuple(sorted({hold.box for hold in self.holds}))

    @property
    def lift(self) -> float:
        """What hangs on the tool [N]."""
        return sum(hold.lift for hold in self.holds)

    def push(self) -> float:
        """The force with which bellows that are pressed in lift the tool [N]."""
        solids, suction, total = self.solids(), self.tool.suction, 0.0
        if not len(solids.centres):
            return 0.0
        centre = self.data.xpos[self.model.tool_body]
        rotation = self.data.xmat[self.model.tool_body].reshape(3, 3)
        for each in self.tool.modules:
            module = self.tool.module(each.name, folded=self.folded)
            points, face = cups_in_cell(module, tuple(range(len(module.cups))), centre, rotation)
            deep = pressed(points, face[:, 0], solids, suction.cup_radius, suction.stroke)
            total -= suction.stiffness * float(deep.sum()) * float(face[2, 0])
        return total

    def _level(self, name: str, good: int) -> float:
        """The vacuum that a module will reach when so many of its open cups seal [Pa]."""
        bad = len(self.open.get(name, ())) - good
        full = self.tool.suction.vacuum * self.supply
        return full * good / (good + LEAK * bad) if good else 0.0

    def _held_cups(self) -> set[Cup]:
        return {cup for hold in self.holds for cup in hold.cups}

    def _pull(self, hold: Hold, now: float) -> float:
        """Area times vacuum of the cups of a hold [N]."""
        suction = self.tool.suction
        levels = [self._valves[name].level(now) for name, _ in hold.cups]
        return suction.cup_force * sum(levels) / suction.vacuum

    def _planes(self) -> list[tuple[str, ...]]:
        """The modules by the plane that their cups touch in."""
        names = tuple(module.name for module in self.tool.modules)
        return [names] if self.folded else [(name,) for name in names]

    def _head_for(self, name: str, level: float, now: float, time: float) -> None:
        valve = self._valves[name]
        self._valves[name] = Valve(valve.level(now), now, level, time)

    def boxes_under(self, cups: tuple[Cup, ...]) -> npt.NDArray[np.int64]:
        """The box that each cup seals on; -1 where there is none."""
        solids, suction = self.solids(), self.tool.suction
        found = np.full(len(cups), -1)
        if not len(solids.centres):
            return found
        centre = self.data.xpos[self.model.tool_body]
        rotation = self.data.xmat[self.model.tool_body].reshape(3, 3)
        for name in sorted({name for name, _ in cups}):
            rows = [row for row, cup in enumerate(cups) if cup[0] == name]
            module = self.tool.module(name, folded=self.folded)
            chosen = tuple(cups[row][1] for row in rows)
            points, face = cups_in_cell(module, chosen, centre, rotation)
            found[rows] = sealed(points, face[:, 0], solids, suction.cup_radius, suction.stroke)
        return found

    def solids(self) -> Solids:
        """All boxes where they are."""
        model = self.model
        return Solids(
            self.data.xpos[model.box_bodies],
            self.data.xmat[model.box_bodies].reshape(-1, 3, 3),
            model.mj.geom_size[model.box_geoms],
        )

    def _weld(self, cups: tuple[Cup, ...], box: int) -> None:
        free = sorted(set(range(WELDS)) - {hold.weld for hold in self.holds})
        if not free:
            return
        suction, plane = self.tool.suction, self.tool.module(cups[0][0], folded=self.folded)
        face_from_flange = plane.flange_from_face.inverse
        centres = []
        for name, cup in cups:
            module = self.tool.module(name, folded=self.folded)
            point = module.flange_from_face.apply((0.0, *module.cups[cup]))
            centres.append(face_from_flange.apply(point)[1:])
        group = CupGroup.of(np.array(centres), suction.cup_radius, suction.friction)
        rotation = np.array(plane.flange_from_face.rotation, dtype=float)
        middle = np.array(plane.flange_from_face.apply((0.0, *group.middle)))
        self._switch_on(free[0], box, middle, suction.stiffness * len(cups))
        hold = Hold(free[0], box, cups, group, rotation)
        self.holds = sorted([*self.holds, hold], key=lambda other: other.weld)

    def _switch_on(self, weld: int, box: int, middle: Floats, stiffness: float) -> None:
        """Ties a box to the tool where both are now."""
        mj, data, tool = self.model.mj, self.data, self.model.tool_body
        body = int(self.model.box_bodies[box])
        turn = data.xmat[tool].reshape(3, 3)
        centre = turn.T @ (data.xpos[body] - data.xpos[tool])
        relative = np.zeros(4)
        back = data.xquat[tool] * np.array([1.0, -1.0, -1.0, -1.0])
        mujoco.mju_mulQuat(relative, back, data.xquat[body])
        box_from_tool = data.xmat[body].reshape(3, 3).T @ turn
        mj.eq_obj2id[weld] = body
        mj.eq_data[weld, :3] = box_from_tool @ (middle - centre)
        mj.eq_data[weld, 3:6] = middle
        mj.eq_data[weld, 6:10] = relative
        mj.eq_data[weld, 10] = TURN_SCALE
        mass = float(mj.body_mass[body])
        k = min(stiffness * (1 - IMPEDANCE) / (IMPEDANCE * mass), STIFFEST)
        mj.eq_solref[weld] = (-k, -2 * DAMPING * np.sqrt(k / IMPEDANCE))
        mj.eq_solimp[weld] = (IMPEDANCE, IMPEDANCE, 0.001, 0.5, 2)
        data.eq_active[weld] = 1

    def _tear(self, hold: Hold, now: float) -> None:
        """Lets go of a box with open valves: they leak from now on."""
        self._let_go(hold)
        for name in sorted({name for name, _ in hold.cups}):
            good = sum(1 for module, _ in self._held_cups() if module == name)
            self._head_for(name, self._level(name, good), now, BURST)

    def _let_go(self, hold: Hold) -> None:
        self.data.eq_active[hold.weld] = 0
        self.holds.remove(hold)
        # At rest beside an arm that never sleeps, the box would fall asleep in the air.
        self.data.xfrc_applied[self.model.box_bodies[hold.box], 2] = TOUCH
        self.let_go = True
