"""ETCS supervision: deceleration curves and the limits that a train is held to."""
