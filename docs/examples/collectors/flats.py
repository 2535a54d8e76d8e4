"""Own figures of each run of a campaign. In its file: collector = "flats.py:flats"."""

TO_BE_TURNED = 0.03  # m, a flat this long sends the wheelset to the lathe; illustrative


def flats(figures):
    length = figures["axle_flat_length"]  # m, (run, axle)
    return {
        "longest_flat": length.max(axis=1),
        "axles_to_turn": (length > TO_BE_TURNED).sum(axis=1),
    }
