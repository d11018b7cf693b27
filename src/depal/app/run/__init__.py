"""The main job: a delivery taken apart in the simulated cell, watched, recorded and summed up."""
