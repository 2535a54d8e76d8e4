"""A page about several runs holds each of them whole, and says how they differ."""

import csv
import io
import re

import numpy as np
import pytest
from tests.unit.report.test_html import EVIL, Page, data_of, unpacked

from railgrip.core.errors import RailgripError
from railgrip.report.comparison_page import comparison_csv, comparison_html, write_comparison
from railgrip.report.differences import difference, differences
from railgrip.report.metrics import Metric, metrics


@pytest.fixture(scope="module")
def text(stop, unprotected):
    return comparison_html({"protected": stop, "no protection": unprotected})


@pytest.fixture(scope="module")
def page(text):
    return Page(text)


def test_it_stands_alone(text, page):
    for tag, attrs in page.tags:
        for name in ("src", "href", "srcset", "action", "data", "poster"):
            assert attrs.get(name, "data:,") == "data:,", (tag, attrs)
    ids = {attrs["id"] for _, attrs in page.tags if "id" in attrs}
    assert set(re.findall(r'(?:byId|on)\("([\w-]+)"', text)) <= ids
    assert not [attrs for _, attrs in page.tags if "style" in attrs]


def test_each_run_is_there_whole(text, stop, unprotected):
    runs = data_of(text)["runs"]
    assert [run["name"] for run in runs] == ["protected", "no protection"]
    for run, truth in zip(runs, (stop, unprotected), strict=True):
        assert {"wheel_speed", "contact_force", "rail_friction", "adhesion_used"} <= set(
            run["axle"]
        )
        assert {"rail_friction_before", "rail_friction_after"} <= set(run["rail"])
        speed = unpacked(run["train"]["train_speed"])
        assert speed[0] == pytest.approx(float(truth.train_speed[0, 0]) * 3.6, abs=0.01)
        force = unpacked(run["axle"]["contact_force"][3])
        assert np.nanmax(force) == pytest.approx(
            -float(truth.contact_force[0, 3].min()) / 1e3, 1e-3
        )


def test_each_run_can_be_looked_at(page):
    choices = [attrs["value"] for attrs in page.of("input") if attrs.get("name") == "looked"]
    assert choices == ["0", "1"]
    against = [attrs for attrs in page.of("div") if "data-against" in attrs]
    assert ["hidden" in attrs for attrs in against] == [False, True]


def test_the_charts_that_are_asked_for(page):
    drawn = {a["id"] for a in page.of("div") if a.get("class") == "chart"}
    wanted = ("speed", "slip", "pressure", "force", "found", "rail", "energy", "temperature")
    assert {f"chart-{name}" for name in wanted} <= drawn


def test_differences_are_stated_both_ways(text, stop, unprotected):
    change = float(unprotected.stopping_distance[0] - stop.stopping_distance[0])
    more, less = ("longer", "shorter") if change > 0 else ("shorter", "longer")
    assert f"no protection stops {abs(change):.1f} m" in text
    assert re.search(rf"no protection stops [^;]* {more} than protected", text)
    assert re.search(rf"protected stops [^;]* {less} than no protection", text)


def test_a_run_that_failed_is_marked_and_shown_as_far_as_it_went(hand):
    failed = hand.isel(time=slice(0, 11)).assign_attrs(failure="wsp.controller: it raised")
    failed["status"] = failed["status"] * 0 + 7
    failed["stopping_distance"] = failed["stopping_distance"] * np.nan
    page = comparison_html({"good": hand, "bad one": failed})
    assert '<span class="bad">wsp.controller: it raised Shown up to 5.00 s.</span>' in page
    assert "bad one does not come to a stand" in page
    assert len(unpacked(data_of(page)["runs"][1]["train"]["train_speed"])) == 11


def test_names_are_escaped(hand):
    page = comparison_html({EVIL: hand, "<b>": hand})
    assert "<script>alert" not in page
    assert "<b>" not in page
    assert len(Page(page).of("script")) == 3


def test_two_to_twelve(hand, stop, tmp_path):
    for count in (0, 1, 13):
        with pytest.raises(RailgripError, match=f"a page holds 2 to 12 runs; got {count}"):
            comparison_html({str(i): hand for i in range(count)})
    with pytest.raises(RailgripError):
        write_comparison({"one": hand}, tmp_path / "page.html")
    assert not list(tmp_path.iterdir())
    eight = write_comparison({f"run {i}": stop for i in range(8)}, tmp_path / "page.html")
    assert eight.stat().st_size < 4.5e6


def test_the_table_as_csv(stop, unprotected):
    table = list(csv.reader(io.StringIO(comparison_csv({"a": stop, "b": unprotected}))))
    assert table[0] == ["figure", "unit", "a", "b"]
    values = {row[0]: row[1:] for row in table[1:]}
    assert values["stopping_distance"][0] == "m"
    expected = [float(data.stopping_distance[0]) for data in (stop, unprotected)]
    assert [float(cell) for cell in values["stopping_distance"][1:]] == pytest.approx(expected)


def test_words_for_what_is_equal_or_unknown():
    one = [Metric("air_used", "", 300.0, "Nl", ""), Metric("locked_time", "", np.nan, "s", "")]
    assert difference("b", one, one, "a") == "b does the same as a."
    shorter = [Metric("stopping_distance", "", 90.0, "m", "")]
    longer = [Metric("stopping_distance", "", 100.0, "m", "")]
    assert differences({"a": longer, "b": shorter}, "a") == [
        "b stops 10.0 m (10.0 %) shorter than a."
    ]


def test_without_traces_the_table_remains(stop, unprotected):
    bare = {"a": stop.drop_dims("time"), "b": unprotected.drop_dims("time")}
    page = comparison_html(bare)
    assert 'class="chart"' not in page
    assert metrics(bare["a"])[1].text in page
