"""The energy-optimal run for a given time, and the timetable made of such runs."""
