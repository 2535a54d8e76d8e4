"""Rare events: quantiles down to one in a thousand million, with intervals that hold.

`failures` enumerates what may have failed, `surrogate` learns where the rare runs lie, `proposal`
draws them, `quantiles` weighs them, `estimate` does all of it in turn.
"""
