import pytest

from railgrip import data
from railgrip.core.errors import RailgripError


@pytest.mark.parametrize("kind", data.KINDS)
def test_every_name_leads_to_a_file(kind):
    assert data.names(kind)
    assert all(data.path(kind, name).is_file() for name in data.names(kind))


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("trains", {"coach_disc", "emu_en14531", "emu_four_car", "locomotive_bobo", "wagon_block"}),
        ("lines", {"level", "uphill_10", "downhill_20", "fribourg_bern", "vasteras_kolback"}),
        ("rail_conditions", {"dry", "wet", "water_detergent", "leaves", "oil", "ice", "low"}),
        ("pads", {"organic", "sinter", "cast_iron", "k_block"}),
        ("discs", {"axle_mounted", "wheel_mounted"}),
        ("scenarios", {"demo", "leaves_160", "freight_stop", "en14531_100", "gradient_hold"}),
    ],
)
def test_the_promised_names_are_there(kind, expected):
    assert expected <= set(data.names(kind))


def test_wrong_name_gets_the_nearest():
    with pytest.raises(RailgripError, match=r"line 'st_gallen_wyl' unknown; .*'st_gallen_wil'\?"):
        data.path("lines", "st_gallen_wyl")


def test_wrong_kind_gets_the_nearest():
    with pytest.raises(RailgripError, match=r"kind of data 'train' unknown; .*'trains'\?"):
        data.names("train")


def test_the_licence_of_the_real_lines_is_shipped():
    folder = data.path("lines", "st_gallen_wil").parent
    assert "BSD 2-Clause" in (folder / "LICENSE").read_text()
    assert "10.1007/s43069-023-00248-x" in (folder / "README.md").read_text()
