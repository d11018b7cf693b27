"""The depalletizing cell: its layout, its tasks, and the parts that carry them out."""
