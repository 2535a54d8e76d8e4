"""Every picture is drawn, says what its axes are, and leaves matplotlib as it was."""

import re

import matplotlib
import pytest

from railgrip.core.errors import RailgripError
from railgrip.report.plots import figures, hero, save_figure, save_figures
from railgrip.report.plots.style import MANY, PALETTE

NAMES = {
    "speeds_time",
    "speeds_distance",
    "slip",
    "pressure",
    "adhesion",
    "rail",
    "temperature",
    "deceleration",
    "energy",
    "air",
}
UNIT = re.compile(r", (s|m|km/h|bar|°C|m/s²|MJ|kJ/m|%|no unit)(?!\w)")


@pytest.fixture(scope="module")
def pictures(stop):
    return figures(stop)


def test_all_pictures(pictures):
    assert set(pictures) == NAMES


@pytest.mark.parametrize("name", sorted(NAMES - {"adhesion"}))
def test_labels_have_units(pictures, name):
    labels = [axes.get_xlabel() for axes in pictures[name].axes]
    labels += [axes.get_ylabel() for axes in pictures[name].axes]
    named = [label for label in labels if label]
    assert named
    assert all(UNIT.search(label) for label in named), named


def test_small_multiples_share_their_labels(pictures):
    whole = pictures["adhesion"]
    assert whole.get_supxlabel() == "Time, s"
    assert "no unit" in whole.get_supylabel()
    assert len(whole.axes) == 16


def test_the_run_is_named(pictures):
    for picture in pictures.values():
        assert "Four-car train on leaves" in [text.get_text() for text in picture.texts]


def test_speeds_are_in_kmh(pictures):
    train = next(
        line for line in pictures["speeds_time"].axes[0].lines if line.get_label() == "train"
    )
    assert max(train.get_ydata()) == pytest.approx(160.0, abs=0.1)


def test_many_axles_become_a_range(long_train):
    axes = figures(long_train)["speeds_time"].axes[0]
    assert long_train.sizes["axle"] > MANY
    assert len(axes.lines) < 8
    words = " ".join(text.get_text() for text in axes.get_legend().get_texts())
    assert "all 84 axles" in words
    assert "worst axle" in words


def test_slip_shows_its_thresholds(stop):
    given = figures(stop, thresholds={"slip_upper": 0.16})["slip"]
    words = [text.get_text() for legend in given.legends for text in legend.get_texts()]
    assert words == ["slip upper"]


def test_a_result_without_some_signals_has_fewer_pictures(hand):
    drawn = figures(hand)
    assert "rail" not in drawn
    assert {"speeds_time", "slip", "pressure", "adhesion", "energy"} <= set(drawn)


def test_hero_takes_the_axle_that_slid_most(unprotected, stop):
    picture = hero(unprotected, stop)
    worst = str(unprotected.axle.values[int(unprotected.axle_slid_energy[0].values.argmax())])
    words = [text.get_text() for text in picture.legends[0].get_texts()]
    assert f"wheel {worst}" in words
    assert "never locked" in picture.axes[1].get_title(loc="left")


def test_the_users_settings_are_left_alone(stop, tmp_path):
    before = dict(matplotlib.rcParams)
    save_figure(figures(stop)["energy"], tmp_path / "energy.png")
    assert dict(matplotlib.rcParams) == before


def test_saved_twice_is_the_same_file(hand, tmp_path):
    first = save_figures(hand, tmp_path / "a", ("svg", "png"))
    second = save_figures(hand, tmp_path / "b", ("svg", "png"))
    assert len(first) == 2 * len(figures(hand))
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
        assert one.stat().st_size > 2000


def test_unknown_format(hand, tmp_path):
    with pytest.raises(RailgripError, match="'jpeg' unknown; allowed: png, svg, pdf"):
        save_figures(hand, tmp_path, ("jpeg",))


def test_the_palette_has_no_two_alike():
    assert len(set(PALETTE)) == len(PALETTE) == 6
