"""
A slide and its protection
==========================

A four-car unit brakes on leaves, once without and once with wheel-slide protection. Without it the
wheels lock and grind flats; with it they slide a little, and the train stands sooner.
"""

# %%
# A shipped scenario, and the same without a controller:

import railgrip as rg

protected = rg.simulate(rg.load("leaves_160"))
unprotected = rg.simulate(protected.scenario.with_({"wsp.controller": "none"}))
print(protected)
print(unprotected)

# %%
# The axle that slid most, speeds above and cylinder pressure below:

from railgrip.report.plots import hero

hero(unprotected, protected)

# %%
# Where the kinetic energy went. No term is a remainder, so the last row is the error of the run.

from railgrip.report.energy import energy_table

for row in energy_table(protected):
    print(f"{row.label:32} {row.energy / 1e6:8.2f} MJ {row.share:8.1%}")

# %%
# Every quantity is an xarray variable with its unit and meaning; axles are labelled by consist,
# vehicle, bogie and place.

protected.data["wheel_speed"]
