"""Serves the screen over a scripted cell: `python served.py PORT STEP [RECORDS]`.

The first account is made by the code `first`; further people sign in with their password.
"""

import secrets
import sys
from pathlib import Path

import uvicorn
from fastapi import FastAPI, Request, Response
from fastapi.responses import JSONResponse
from memory_desk import Memory, MemoryDesk
from scripted_cell import ScriptedCell

from depal.server.cell import Cell
from depal.server.roles import Principal, Role
from depal.server.screen.desk import Refused
from depal.server.screen.site import attach

COOKIE = "depal"
NOBODY = Principal("", Role.INTEGRATOR)


class Sessions:
    """Who is signed in."""

    def __init__(self, memory: Memory) -> None:
        self.memory = memory
        self.names: dict[str, str] = {}

    def desk(self, request: Request) -> MemoryDesk | None:
        name = self.names.get(request.cookies.get(COOKIE, ""), "")
        person = next((each for each in self.memory.people if each.name == name), None)
        if person is None:
            return None
        return MemoryDesk(self.memory, Principal(person.name, person.role))

    def open(self, name: str) -> Response:
        key = secrets.token_urlsafe(24)
        self.names[key] = name
        answer = JSONResponse({"name": name})
        answer.set_cookie(COOKIE, key, httponly=True, samesite="strict")
        return answer


def problem(status: int, detail: str) -> Response:
    return JSONResponse({"status": status, "detail": detail}, status)


def application(cell: Cell, records: Path | None) -> FastAPI:
    app = FastAPI()
    sessions = Sessions(Memory(cell, records))
    memory = sessions.memory

    @app.post("/api/v1/first-account")
    async def first(request: Request) -> Response:
        given = await request.json()
        if given["code"] != "first" or memory.people:
            return problem(403, "this link has been used already")
        try:
            add = MemoryDesk(memory, NOBODY).add_person
            add(given["name"], Role.INTEGRATOR, given["password"])
        except Refused as refusal:
            return problem(422, str(refusal))
        return sessions.open(given["name"])

    @app.post("/api/v1/sign-in")
    async def sign_in(request: Request) -> Response:
        given = await request.json()
        if memory.passwords.get(given["name"]) != given["password"]:
            return problem(401, "name or password is wrong")
        return sessions.open(given["name"])

    @app.post("/api/v1/sign-out")
    async def sign_out(request: Request) -> Response:
        sessions.names.pop(request.cookies.get(COOKIE, ""), None)
        return Response(status_code=204)

    attach(app, cell, sessions)
    return app


if __name__ == "__main__":
    port, step, *folder = sys.argv[1:]
    cell = ScriptedCell(float(step))
    app = application(cell, Path(folder[0]) if folder else None)
    uvicorn.run(app, host="127.0.0.1", port=int(port), log_level="warning")
