"""What was assumed, for the page: what scatters, what goes together, what fails."""

from __future__ import annotations

from railgrip.campaign.safety.factors import SafetyFactors
from railgrip.report.static_page import table

ASSUMPTIONS = (
    "Nominal: dry rail, level line, the train exactly as its file says, nothing failed.",
    "Deceleration distance: from the brake command to standstill, less the distance run until the "
    "end of the nominal equivalent build-up time. A slower filling lowers K.",
    "K_dry_rst(V, EBCL): nominal over real deceleration distance from V; a stop stays above it "
    "with the confidence of the level. K_wet_rst(V): mean deceleration distance dry over wet, the "
    "same trains on both, none failed.",
    "A_brake_safe = K_dry (K_wet + M_NVAVADH (1 − K_wet)) A_brake_emergency (SUBSET-026 §3.13).",
    "Quantities scatter independently unless 'per' or a correlation ties them; units fail "
    "independently. A failed unit gives no brake force, nobody notices, and nothing takes its "
    "place but what a deceleration controller asks of the others. Where the brake control itself "
    "fails, the brakes work as without it.",
    "Failed units are enumerated with exact probabilities. The rest is sampled beyond where each "
    "level begins, along a direction that pilot runs found, and weighted exactly (balance "
    "heuristic). Pilots are not counted.",
    "Intervals: all values that the sample does not contradict, by its own variance; 95 % for each "
    "level, and wider ones that hold all ten levels at once with 95 %.",
)


def variables(found: SafetyFactors) -> str:
    """Return the tables of what scatters and what goes together."""
    rows = []
    for one in found.case.variables:
        numbers = ", ".join(f"{name} {getattr(one, name)}" for name in
                            ("mean", "deviation", "low", "mode", "high")
                            if getattr(one, name) is not None)  # fmt: skip
        if one.values:
            sample = one.sample
            numbers = f"{len(sample)} values, {min(sample):g} … {max(sample):g} (SI) {one.file}"
        rows.append([one.label, one.per, one.means, one.distribution, numbers,
                     ", ".join(one.brakes) or "all", one.source])  # fmt: skip
    heads = ["quantity", "per", "as", "distribution", "numbers", "brakes", "source"]
    return table(heads, rows, "What scatters", "text") + _correlations(found)


def _correlations(found: SafetyFactors) -> str:
    rows = [
        [first, second, f"{one.matrix[i][j]:g}"]
        for one in found.case.correlation
        for i, first in enumerate(one.variables)
        for j, second in enumerate(one.variables)
        if i < j
    ]
    heads = ["", "with", "correlation of normal scores, within each place"]
    return table(heads, rows, "What goes together (Gaussian copula)", "text") if rows else ""


def failures(found: SafetyFactors) -> str:
    """Return the table of what fails, with how many states were enumerated."""
    rows = [
        [one.per, f"{one.latent:g}", f"{one.on_demand:g}", f"{one.probability:.6g}",
         ", ".join(one.brakes) or "all", one.source]
        for one in found.case.failures
    ]  # fmt: skip
    if not rows:
        return "<p>No unit fails.</p>"
    heads = ["unit", "latent", "on demand", "together", "brakes", "source"]
    states = found.layout.states
    told = (
        f"What fails: {len(found.layout.fails)} units, {len(states.weight)} different states "
        f"enumerated, {states.left_out:.1e} left out and counted against the train"
    )
    return table(heads, rows, told, "text")
