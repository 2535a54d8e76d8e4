"""Coasting-initiation: traction ends early enough to meet the braking curve later and slower."""
