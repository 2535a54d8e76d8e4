"""A measured stop: read from CSV by a channel map, laid over a simulated one, compared with it."""

from __future__ import annotations

from railgrip.io.measured.channel_map import Channel, ChannelMap, read_channel_map
from railgrip.io.measured.comparing import Difference, MeasuredComparison, compare_measured
from railgrip.io.measured.reading import read_measured
from railgrip.io.measured.stop import MeasuredStop

__all__ = [
    "Channel",
    "ChannelMap",
    "Difference",
    "MeasuredComparison",
    "MeasuredStop",
    "compare_measured",
    "read_channel_map",
    "read_measured",
]
