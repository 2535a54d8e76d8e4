"""From measured stops to the three functions of a pad: fit, intervals, comparison of models."""

from __future__ import annotations

from railgrip.laboratory.pad_fit.comparison import Score, compare_laws
from railgrip.laboratory.pad_fit.data import INFLUENCES, PadStops
from railgrip.laboratory.pad_fit.identify import Identified, Plan, identify_pad
from railgrip.laboratory.pad_fit.shape import Shape

__all__ = [
    "INFLUENCES",
    "Identified",
    "PadStops",
    "Plan",
    "Score",
    "Shape",
    "compare_laws",
    "identify_pad",
]
