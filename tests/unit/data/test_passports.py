"""Every number that is shipped says where it comes from."""

import re
import tomllib

import pytest

from railgrip import data

FILES = [
    pytest.param(path, id=f"{kind}/{path.stem}")
    for kind in data.KINDS
    for path in (data.path(kind, name) for name in data.names(kind))
    if path.suffix == ".toml"
]
# Words that may hold a digit without being a quantity.
NAMES = {
    "title", "title_de", "source", "name", "extends", "train", "use", "condition", "pad", "disc",
    "report", "against",
}  # fmt: skip
QUANTITY = re.compile(r"""(?<![A-Za-z_\d])[-+]?\d""")


def numbers_without_passport(text):
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("["):
            continue  # the name of a table may hold a digit
        code, _, comment = line.partition("#")
        # a limit of a profile carries its passport as a field, for the protocol to print
        comment += "".join(re.findall(r'source = "([^"]*)"', code))
        key = code.partition("=")[0].strip()
        bare_name = key in NAMES and not code.partition("=")[2].strip().startswith("{")
        if QUANTITY.search(code) and not bare_name and not re.search(r"[A-Za-z]{2}", comment):
            found.append(f"{number}: {line}")
    return found


@pytest.mark.parametrize("path", FILES)
def test_every_number_has_a_source_beside_it(path):
    assert numbers_without_passport(path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("path", FILES)
def test_every_file_has_a_title_a_source_and_a_comment_on_top(path):
    text = path.read_text(encoding="utf-8")
    table = tomllib.loads(text)
    assert text.startswith("# ")
    assert table["title"]
    assert table.get("source") or "extends" in table


def test_the_scan_finds_a_number_without_source():
    text = 'title = "from 160 km/h"\nmass = "44 t"\nspeed = 3  # data sheet\nx = [\n  1.0,\n]\n'
    assert numbers_without_passport(text) == ['2: mass = "44 t"', "5:   1.0,"]
