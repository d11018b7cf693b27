"""`depal learn`: from recorded orders of unloading to the weights behind them."""

from depal.app.learning.job import learn_from
from depal.app.learning.order_file import order_schema, read_orders, write_orders
from depal.app.learning.report import learn_report, recovery_report
from depal.app.learning.weights import weights_of

__all__ = [
    "learn_from",
    "learn_report",
    "order_schema",
    "read_orders",
    "recovery_report",
    "weights_of",
    "write_orders",
]
