"""The test programme: qualifying a wheel-slide protection at the desk, before the track."""
