"""Trees of tasks as text, as SVG and as Mermaid flowcharts."""

from depal.executive.drawing.mermaid import tree_mermaid
from depal.executive.drawing.svg import tree_svg
from depal.executive.drawing.text import tree_text

__all__ = ["tree_mermaid", "tree_svg", "tree_text"]
