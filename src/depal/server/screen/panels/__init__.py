"""Parts of the screen as markup: pure functions of the cell's state."""
