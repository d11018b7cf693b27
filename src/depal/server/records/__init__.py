"""What the store's side keeps: the queue, runs, questions, requests, pictures, settings."""

from depal.server.records.pictures import Pictures, PictureView
from depal.server.records.products import Products
from depal.server.records.questions import Questions, QuestionView
from depal.server.records.queue import Queue, QueuedView
from depal.server.records.repeats import Repeats
from depal.server.records.requests import Requests, RequestView
from depal.server.records.runs import Runs, RunView
from depal.server.records.settings import Kept, KeptSettings

__all__ = [
    "Kept",
    "KeptSettings",
    "PictureView",
    "Pictures",
    "Products",
    "QuestionView",
    "Questions",
    "Queue",
    "QueuedView",
    "Repeats",
    "RequestView",
    "Requests",
    "RunView",
    "Runs",
]
