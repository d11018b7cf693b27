"""Serves the screen over a scripted cell: `python served.py PORT [STEP]`."""

import sys

import uvicorn
from fastapi import FastAPI
from scripted_cell import ScriptedCell

from depal.server.screen.site import attach

if __name__ == "__main__":
    step = float(sys.argv[2]) if len(sys.argv) > 2 else 0.1
    application = FastAPI()
    attach(application, ScriptedCell(step))
    uvicorn.run(application, host="127.0.0.1", port=int(sys.argv[1]), log_level="warning")
