"""Draw the picture of the README from two runs: python docs/make_pictures.py."""

from pathlib import Path

import railgrip as rg
from railgrip.report.plots import hero, save_figure

protected = rg.load("leaves_160")
unprotected = protected.with_({"wsp.controller": "none"})
figure = hero(rg.simulate(unprotected), rg.simulate(protected))
save_figure(figure, Path(__file__).parent / "_static" / "slide_and_protection.png")
