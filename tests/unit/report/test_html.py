"""The page stands alone, runs nothing foreign, escapes what it is given, and says it all."""

import base64
import hashlib
import json
import re
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pytest

from railgrip.report.html import CHARTS, ONLY_COMPARED, report_html, write_report
from railgrip.report.payload import packed

EVIL = "</title><script>alert('é & \"you\"')</script>"


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.tags, self.scripts, self._in = [], [], None
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag in ("script", "style"):
            self._in = (tag, dict(attrs))
            self.scripts.append([tag, dict(attrs), ""])

    def handle_endtag(self, tag):
        self._in = None

    def handle_data(self, text):
        if self._in:
            self.scripts[-1][2] += text

    def of(self, tag):
        return [attrs for name, attrs in self.tags if name == tag]


@pytest.fixture(scope="module")
def text(stop):
    return report_html(stop, limits={"stopping_distance": 1000.0, "locked_time": 5.0})


@pytest.fixture(scope="module")
def page(text):
    return Page(text)


def unpacked(field):
    if "u16" not in field:
        return np.full(field["n"], field["low"], dtype=float)
    counts = np.frombuffer(base64.b64decode(field["u16"]), "<u2").astype(float)
    return np.where(counts == 65535, np.nan, field["low"] + counts * field["step"])


def data_of(text):
    return json.loads(re.search(r'id="data">(.*?)</script>', text, re.S)[1])


def test_nothing_is_loaded_from_anywhere(text, page):
    for tag, attrs in page.tags:
        for name in ("src", "href", "srcset", "action", "data", "poster"):
            assert attrs.get(name, "data:,") == "data:,", (tag, attrs)
    assert page.of("iframe") == page.of("object") == page.of("img") == []
    styles = " ".join(body for tag, _, body in page.scripts if tag == "style")
    assert "@import" not in styles
    assert "url(" not in styles
    ours = text[text.rindex('"use strict";\n(() => {') :]
    assert not re.search(r"fetch\(|XMLHttpRequest|WebSocket|import\(|https?://", ours)


def test_only_its_own_scripts_may_run(page):
    (policy,) = [a["content"] for a in page.of("meta") if "http-equiv" in a]
    assert policy.startswith("default-src 'none';")
    assert "unsafe" not in policy
    for _tag, attrs, body in page.scripts:
        if attrs.get("type") == "application/json":
            continue
        digest = base64.b64encode(hashlib.sha256(body.encode()).digest()).decode()
        assert f"'sha256-{digest}'" in policy
    assert not [name for _, attrs in page.tags for name in attrs if name.startswith("on")]
    assert not [attrs for _, attrs in page.tags if "style" in attrs]


def test_titles_are_escaped(hand):
    hand.attrs["title"] = EVIL
    hand.attrs["scenario_json"] = json.dumps({"title": EVIL})
    hand.attrs["seed"] = "<b>"
    other = hand.assign_attrs(title="x")
    page = report_html(hand, ghost={EVIL: other})
    assert "<script>alert" not in page
    assert "<b>" not in page
    assert "&lt;/title&gt;&lt;script&gt;alert" in page
    assert len(Page(page).of("script")) == 3


def test_accessible(text, page):
    assert page.of("html") == [{"lang": "en"}]
    assert len(page.of("h1")) == 1
    assert all(attrs.get("scope") in ("col", "row") for attrs in page.of("th"))
    assert len(page.of("caption")) == len(page.of("table")) - 1  # one is filled by the cursor
    charts = [attrs for attrs in page.of("div") if attrs.get("class") == "chart"]
    assert len(charts) == len(CHARTS) - len(ONLY_COMPARED) - 2  # no sand, no motor
    assert all(attrs["role"] == "img" and attrs["aria-label"] for attrs in charts)
    assert 'name="viewport"' in text


def test_every_element_that_the_script_asks_for_is_there(text, page):
    ids = {attrs["id"] for _, attrs in page.tags if "id" in attrs}
    asked = set(re.findall(r'(?:byId|on)\("([\w-]+)"', text))
    assert asked <= ids
    assert len(ids) == sum("id" in attrs for _, attrs in page.tags)


def test_what_the_header_says(text, stop):
    assert "<h1>Four-car train on leaves</h1>" in text
    assert "The train came to a stand." in text
    assert text.count("imulation, not an approval") == 2
    assert "seed 1" in text
    assert f"{float(stop.stopping_distance[0]):.1f} m" in text


def test_limits_passed_and_missed(text):
    assert "Limits: 1 of 2 missed" in text
    assert re.search(r'<li class="bad">Stopping distance: .* missed</li>', text)
    assert re.search(r'<li class="good">Longest lock: .* passed</li>', text)


def test_limits_of_the_scenario(hand):
    hand.attrs["scenario_json"] = json.dumps({"limits": {"stopping_distance": 250.0}})
    assert "Limits: all passed" in report_html(hand)


def test_a_run_that_did_not_stop_is_marked(hand):
    hand["status"][:] = 5
    assert '<p class="status bad">The time limit passed' in report_html(hand)


def test_traces_survive_the_packing(text, stop):
    data = data_of(text)
    speed = unpacked(data["axle"]["wheel_speed"][5])
    truth = stop.wheel_speed[0, 5].values * 3.6
    assert np.abs(speed - truth).max() < 0.002
    valve = unpacked(data["axle"]["dump_valve"][5])
    assert np.array_equal(np.round(valve), stop.dump_valve[0, 5].values)
    assert data["axles"][5] == "C1-V2-B1-A2"
    assert data["vehicle_of"][5] == 1


def test_packing_keeps_gaps():
    values = np.array([1.0, np.nan, 3.0])
    assert unpacked(packed(values)) == pytest.approx(values, nan_ok=True, abs=1e-4)
    assert packed(np.full(3, np.nan)) == {"n": 3, "low": None}


def test_sizes(text, long_train):
    assert len(text.encode()) < 2e6
    assert len(report_html(long_train).encode()) < 6e6


def test_a_very_long_record_is_thinned(hand):
    many = 200_000
    time = np.linspace(0, 20, many)
    long = hand.interp(time=time).assign_coords(time=time)
    long["train_speed"][0, 100_001] = 25.0  # one sample that must not get lost
    page = report_html(long)
    assert len(page) < 1e6
    assert unpacked(data_of(page)["train"]["train_speed"]).max() == pytest.approx(90.0, abs=0.01)


def test_ghosts_are_drawn_and_compared(stop, unprotected):
    page = report_html(stop, ghost={"no protection": unprotected})
    (ghost,) = data_of(page)["ghosts"]
    assert ghost["name"] == "no protection"
    assert set(ghost["axle"]) == {"wheel_speed", "brake_cylinder_pressure"}
    assert '<th scope="col">no protection</th>' in page
    change = float(unprotected.stopping_distance[0] - stop.stopping_distance[0])
    assert f"({change:+.1f})" in page


def test_a_measured_stop_is_drawn_and_tabled(hand):
    row = SimpleNamespace(
        label="Distance <to> a stand", simulated=200.0, measured=160.0, difference=40.0, unit="m"
    )
    measured = SimpleNamespace(
        title="Test 7",
        time=np.array([0.0, 10.0, 20.0]),
        distance=np.array([0.0, 150.0, 200.0]),
        train={"train_speed": np.array([20.0, 10.0, 0.0])},
        axles={"wheel_speed": {"C1-V1-B1-A2": np.array([20.0, 9.0, 0.0])}},
        rows=[row],
    )
    page = report_html(hand, measured=measured)
    (overlay,) = data_of(page)["ghosts"]
    assert overlay["measured"] is True
    assert unpacked(overlay["train"]["train_speed"]) == pytest.approx([72, 36, 0], abs=0.01)
    assert overlay["axles"] == ["C1-V1-B1-A2"]
    assert "Distance &lt;to&gt; a stand" in page
    assert "40.0 (+25.0 %)" in page


def test_a_result_without_traces_still_has_its_figures(hand):
    bare = hand.drop_dims("time")
    page = report_html(bare)
    assert "200.0 m" in page
    assert 'class="chart"' not in page


def test_written_whole_or_not_at_all(hand, tmp_path):
    path = write_report(hand, tmp_path / "stop.html")
    assert path.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    with pytest.raises(Exception, match="unknown"):
        write_report(hand, tmp_path / "bad.html", limits={"nonsense": 1.0})
    assert [file.name for file in tmp_path.iterdir()] == ["stop.html"]
