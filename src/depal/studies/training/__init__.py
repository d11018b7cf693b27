"""Training of what perception believes, on simulated scenes."""
