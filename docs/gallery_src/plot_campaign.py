"""
How far does the stopping distance scatter?
===========================================

An emergency brake of a four-car unit from 120 km/h on dry rail, as the shipped campaign
``dry_emergency`` draws it: pressures, efficiencies, pads, filling times and mass scatter, and a
bogie's brake fails with 1.1 in a thousand. 256 stops tell the median to a metre or two, and little
about the one stop in a thousand: the band says how little.
"""

# %%
# The campaign is drawn and run as one batch; what was drawn stands beside what came out.
import numpy as np

from railgrip.campaign.batch import Batches
from railgrip.campaign.campaign_file import read_campaign_file
from railgrip.campaign.statistics import difference, exceedance, mean, proportion, quantile
from railgrip.report.plots.campaign import exceedance as exceedance_plot

campaign = read_campaign_file("dry_emergency")
batches = Batches(campaign)
table = batches.table(0, 256)
distance = table["stopping_distance"]

middle, high = mean(distance), quantile(distance, 0.99)
print(f"mean {middle.value:.1f} m, 95 % from {middle.low:.1f} to {middle.high:.1f} m")
print(f"99 % quantile {high.value:.1f} m, from {high.low:.1f} to {high.high:.1f} m")
assert middle.low < 481.0 < middle.high  # as 2048 stops have it
assert high.high == np.inf  # 256 runs give no upper bound for it

# %%
# How often each distance is exceeded, with the exact binomial band. Beyond the longest stop of the
# sample the share is 0, and the band still reaches 1.4 % (3.7 runs of 256).
thresholds = np.linspace(distance.min(), distance.max() + 5.0, 200)
band = exceedance(distance, thresholds)
assert abs(proportion(0, 256).high - 0.0143) < 1e-4
exceedance_plot(distance, band, thresholds, "Stopping distance, m")

# %%
# No bogie failed in these 256 runs, so what a failure does is asked for: the first 64 runs again,
# on the same draws, with the first bogie, a motor bogie, cut out: 16 % of the brake force. The
# difference run by run is known better from 64 runs than the mean from four times as many.
draws = batches.drawing.draw(0, 64)
draws["failed_V1_B1"] = np.ones(64, dtype=bool)
cut_out = batches.figures(draws, np.arange(64))["stopping_distance"]
longer = difference(distance[:64], cut_out)
print(f"{longer.value:.1f} m longer, 95 % from {longer.low:.1f} to {longer.high:.1f} m")
assert not any(table[name].any() for name in table if name.startswith("failed"))
assert longer.low > 0.0
assert longer.width < middle.width
