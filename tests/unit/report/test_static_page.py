"""Pages without scripts load nothing and escape what they are given."""

import base64
import hashlib
import re

import pytest
from matplotlib.figure import Figure

from railgrip.report.static_page import heading, picture, static_page, table


def test_policy_lets_exactly_the_own_style_through():
    page = static_page("A", ["<p>b</p>"], ".own { color: red; }")
    sheet = page.split("<style>")[1].split("</style>")[0]
    told = re.search(r"style-src 'sha256-([^']+)'", page)
    assert told
    assert told[1] == base64.b64encode(hashlib.sha256(sheet.encode()).digest()).decode()
    assert "script-src 'none'" in page


@pytest.mark.parametrize(
    "made",
    [
        heading("<b>", "<b>", "<b>"),
        table(["<b>", "<b>"], [["<b>", "<b>"]], "<b>"),
        static_page("<b>", []),
    ],
)
def test_what_is_given_is_text(made):
    assert "<b>" not in made


def test_a_picture_has_words_and_its_size():
    made = picture(Figure(figsize=(5, 2)), "speed over distance")
    assert 'alt="speed over distance"' in made
    assert 'width="480"' in made
