"""The options of `railgrip contact`, in groups; texts as the user wrote them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from cyclopts import Group, Parameter

Signed = Parameter(allow_leading_hyphen=True)


@Parameter(name="*", group=Group("Wheel and rail", sort_key=1))
@dataclass(frozen=True)
class Geometry:
    """The pair, and changes to it.

    Parameters
    ----------
    pair
        Wheel and rail: a name of `railgrip list contact-pairs`, or a file.
    wheel_radius
        Rolling radius of the wheel, in place of the pair's.
    wheel_transverse_radius
        Transverse radius of the tread; negative: hollow.
    position
        Place of contact on the profile S1002, positive towards the field side.
    rail_transverse_radius
        Transverse radius of the rail head.
    young
        Young's modulus of both.
    poisson
        Poisson's ratio of both.
    rail
        Rail condition: a name of `railgrip list rail-conditions`, or a file.
    friction
        One friction coefficient at any slip speed, in place of --rail.
    """

    pair: str = "cone_on_head"
    wheel_radius: Annotated[str, Signed] = ""
    wheel_transverse_radius: Annotated[str, Signed] = ""
    position: Annotated[str, Signed] = ""
    rail_transverse_radius: Annotated[str, Signed] = ""
    young: Annotated[str, Signed] = ""
    poisson: Annotated[str, Signed] = ""
    rail: str = "dry"
    friction: Annotated[str, Signed] = ""


@Parameter(name="*", group=Group("What the wheel does", sort_key=2))
@dataclass(frozen=True)
class Motion:
    """Load, speed, creepages.

    Parameters
    ----------
    load
        Normal force on the wheel.
    speed
        Speed of the train.
    creepage
        Longitudinal: (wheel speed − train speed)/train speed, positive when driving; 0.2 % if
        no creepage and no spin is given or swept.
    lateral
        The same across the track.
    spin
        Rotation about the normal of the contact over the speed of the train, e.g. "0.5 1/m".
    wheel_temperature
        With which the tread enters the patch.
    rail_temperature
        With which the rail enters the patch.
    """

    load: Annotated[str, Signed] = "100 kN"
    speed: Annotated[str, Signed] = "72 km/h"
    creepage: Annotated[str, Signed] = ""
    lateral: Annotated[str, Signed] = ""
    spin: Annotated[str, Signed] = ""
    wheel_temperature: Annotated[str, Signed] = "20 degC"
    rail_temperature: Annotated[str, Signed] = "20 degC"


@Parameter(name="*", group=Group("Sweep", sort_key=3))
@dataclass(frozen=True)
class Range:
    """What is varied.

    Parameters
    ----------
    sweep
        Vary this: creepage, lateral, spin, speed or load.
    begin
        First value.
    end
        Last value.
    points
        How many values.
    """

    sweep: str = ""
    begin: Annotated[str, Parameter(name="--from", allow_leading_hyphen=True)] = ""
    end: Annotated[str, Parameter(name="--to", allow_leading_hyphen=True)] = ""
    points: Annotated[int, Signed] = 81


@Parameter(name="*", group=Group("Output", sort_key=4))
@dataclass(frozen=True)
class Output:
    """What is shown and written.

    Parameters
    ----------
    over
        Show creepage as "creepage" or as "slip-speed".
    show
        Show forces as "adhesion" or as "force".
    with_map
        Also draw the patch from above, by the first law that has a map.
    out
        Folder for data and figures; ./out/contact if figures are asked for.
    figures
        Formats of the figures: png,svg,pdf; png if not given.
    as_json
        Print one JSON object instead of the tables.
    """

    over: str = "creepage"
    show: str = "adhesion"
    with_map: Annotated[bool, Parameter(name="--map")] = False
    out: Path | None = None
    figures: str = ""
    as_json: Annotated[bool, Parameter(name="--json")] = False
