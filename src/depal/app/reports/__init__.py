"""Results for people and for programs: tables, pictures and JSON fields of each study."""

from depal.app.reports.bench import bench_report
from depal.app.reports.case2 import case2_report
from depal.app.reports.due import due_report
from depal.app.reports.fig4 import fig4_report
from depal.app.reports.fig5 import fig5_report
from depal.app.reports.fig8 import fig8_report
from depal.app.reports.fig9 import fig9_report
from depal.app.reports.hidden import hidden_report
from depal.app.reports.report import Report
from depal.app.reports.retrieval import retrieval_report
from depal.app.reports.stability import stability_report
from depal.app.reports.table1 import table1_report
from depal.app.reports.unload import unload_report

__all__ = [
    "Report",
    "bench_report",
    "case2_report",
    "due_report",
    "fig4_report",
    "fig5_report",
    "fig8_report",
    "fig9_report",
    "hidden_report",
    "retrieval_report",
    "stability_report",
    "table1_report",
    "unload_report",
]
