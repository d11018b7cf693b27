"""Each module is one step; none is ever changed once it was released."""
