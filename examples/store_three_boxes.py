"""Three boxes stored under the paper's task, in simulated time, with a record to replay.

python examples/store_three_boxes.py RECORD && depal replay RECORD --all
"""

import asyncio
import sys
import tempfile
from importlib.resources import files
from pathlib import Path

from depal.executive.clock import LoopClock, run_simulated
from depal.executive.engine import Call, Engine, Report
from depal.executive.language import parse
from depal.executive.record import open_record
from depal.executive.runtime import Context, Primitive, Runtime
from depal.executive.schema import Action

tasks = parse((files("depal.cell.tasks") / "store.task").read_text(encoding="utf-8"), "store.task")


def primitive(name: str) -> Primitive:
    """A device that takes two seconds and always succeeds."""

    async def run(context: Context) -> Report:
        await asyncio.sleep(2.0)
        box = context.args["Box"]
        effects = {
            "kr60_reach": (("kr60.at", box),),
            "kr60_grasp": ((f"{box}.taken", True),),
            "kr60_show": (("kr60.at", "reader"),),
            "read_barcode": ((f"{box}.known", True),),
            "ask_target": ((f"{box}.target", "trolley_1"),),
            "kr60_carry": (("kr60.at", context.facts[f"{box}.target"]),)
            if name == "kr60_carry"
            else (),
            "kr60_release": ((f"{box}.taken", False), (f"{box}.stored", True), ("kr60.at", None)),
        }
        return Report(effects[name])

    return run


async def work(folder: Path) -> None:
    """Stores three boxes, of which the camera knows the first."""
    names = [name for name, schema in tasks.schemata.items() if isinstance(schema, Action)]
    bound = {name: primitive(name) for name in names}
    probes = {"arm": bound["kr60_reach"], "gripper": bound["kr60_grasp"]}
    with open_record(folder, tasks) as journal:
        runtime = Runtime(Engine(tasks), journal, LoopClock(), bound, probes)
        runtime.change([("b1.known", True)], "camera")
        ended = asyncio.Event()
        runtime.listen(lambda _, __: ended.set() if not runtime.engine.state.trees else None)
        runtime.allocate(*(Call("store", (box,)) for box in ("b1", "b2", "b3")))
        await ended.wait()
        now = asyncio.get_running_loop().time()
        print(f"three boxes stored after {now:.0f} simulated seconds, {journal.last} events")


if len(sys.argv) > 1:
    run_simulated(work(Path(sys.argv[1])))
else:
    with tempfile.TemporaryDirectory() as temporary:
        run_simulated(work(Path(temporary)))
