"""The simulated cell behind the ports: physics, devices, people, and a referee who knows."""
