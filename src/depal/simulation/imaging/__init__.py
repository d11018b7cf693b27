"""Pictures of the simulated cell: a software rasteriser, printed boxes, reader and camera."""
