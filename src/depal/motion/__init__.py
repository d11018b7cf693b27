"""How the arm moves: kinematics, collision, grasps, planning, timing. Pure functions of values."""
