"""A wheel on a rail, new or worn: radii and material, from which a creep law gets its contact."""

from __future__ import annotations

import math
import os
from typing import NamedTuple

from pydantic import Field, ValidationError, model_validator

from railgrip.contact.rectangular_patch import RectangularPatch, rectangular_patch
from railgrip.contact.rolling_contact import RollingContact, rolling_contact
from railgrip.contact.s1002_contact import refuse_hollow_contact, s1002_radii
from railgrip.core.errors import Problem, RailgripError
from railgrip.scenario import library
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.explain import problems_of
from railgrip.scenario.units import Dimensionless, Length, Stress


class PairGeometry(NamedTuple):
    """Radii and material of a pair, in the order in which `rolling_contact` takes them.

    Parameters
    ----------
    wheel_radius : float
        In the plane of rolling [m].
    wheel_transverse_radius, rail_transverse_radius : float
        Across the track [m]; negative where concave, `inf` where straight.
    young, poisson : float
        Of both bodies [Pa], [-].
    """

    wheel_radius: float
    wheel_transverse_radius: float
    rail_transverse_radius: float
    young: float
    poisson: float


class PairWheel(Model):
    """The wheel where it touches the rail: a cone, an arc or a place on the profile S1002."""

    radius: Length = Field(ge=0.05, le=2, description="Rolling radius, at the running circle.")
    transverse_radius: Length | None = Field(
        default=None, description="Of the tread; negative: concave; absent: straight, a cone."
    )
    s1002_position: Length | None = Field(
        default=None,
        ge=-0.07,
        le=0.06,
        description="Place on the profile S1002, positive towards the field side.",
    )

    @model_validator(mode="after")
    def _one_shape(self) -> PairWheel:
        if self.transverse_radius == 0.0:
            refuse([Problem("transverse_radius", "must not be zero", cure="leave it out: a cone")])
        if None not in (self.transverse_radius, self.s1002_position):
            refuse([Problem("s1002_position", "excludes transverse_radius", cure="drop either")])
        return self


class PairRail(Model):
    """The rail where it is touched: a round or flat head, or a head worn flat over a width."""

    head_radius: Length | None = Field(
        default=None, description="Transverse; negative: concave; absent: flat."
    )
    worn_width: Length | None = Field(
        default=None, gt=0, le=0.1, description="Width of the rectangular patch."
    )

    @model_validator(mode="after")
    def _one_shape(self) -> PairRail:
        if self.head_radius == 0.0:
            refuse([Problem("head_radius", "must not be zero", cure="leave it out: a flat head")])
        if None not in (self.head_radius, self.worn_width):
            refuse([Problem("worn_width", "excludes head_radius", cure="drop either")])
        return self


class ContactPair(Model):
    """A wheel on a rail; `railgrip list contact-pairs` shows those that are shipped."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    wheel: PairWheel = Field(description="Radii of the wheel.")
    rail: PairRail = Field(description="Radius or width of the rail head.")
    young: Stress = Field(default=210e9, gt=0, le=1e12, description="Young's modulus of both.")
    poisson: Dimensionless = Field(default=0.28, ge=0, le=0.5, description="Poisson's ratio.")

    @model_validator(mode="after")
    def _flat_on_flat(self) -> ContactPair:
        wheel, rail = self.wheel, self.rail
        is_cone = wheel.transverse_radius is None and wheel.s1002_position is None
        if rail.worn_width is not None and not is_cone:
            refuse([Problem("rail.worn_width", "needs a straight tread", cure="a cone, or a head")])
        if rail.worn_width is None and rail.head_radius is None and is_cone:
            refuse(
                [
                    Problem(
                        "rail",
                        "a cone on a flat head touches along a line",
                        cure="give head_radius or worn_width",
                    )
                ]
            )
        return self

    def geometry(self) -> PairGeometry:
        """Return radii and material of an elliptic contact.

        Raises
        ------
        RailgripError
            For a worn head: "the patch of this pair is a rectangle, not an ellipse"; for S1002
            where Hertz has no solution, as `s1002_contact`.
        """
        wheel, rail = self.wheel, self.rail
        if rail.worn_width is not None:
            raise RailgripError(
                Problem(
                    "",
                    "the patch of this pair is a rectangle, not an ellipse",
                    got=self.title,
                    cure="rectangle_of_pair, or a pair with a head_radius",
                )
            )
        head = math.inf if rail.head_radius is None else rail.head_radius
        if wheel.s1002_position is None:
            across = math.inf if wheel.transverse_radius is None else wheel.transverse_radius
            return PairGeometry(wheel.radius, across, head, self.young, self.poisson)
        radii = s1002_radii(wheel.radius, wheel.s1002_position)
        refuse_hollow_contact(wheel.s1002_position, radii.across, head)
        return PairGeometry(radii.along, radii.across, head, self.young, self.poisson)


def contact_pair(name: str | os.PathLike[str]) -> ContactPair:
    """Return a pair by its shipped name or from a file.

    Parameters
    ----------
    name : str or path
        A name from `railgrip list contact-pairs`, or a TOML file.

    Returns
    -------
    ContactPair
        Checked and frozen.

    Raises
    ------
    RailgripError
        ``contact pair 's1002_nw' unknown; known: …; did you mean 's1002_new'?``; every key that
        is wrong, with its place.

    Examples
    --------
    >>> contact_pair("cone_on_head").rail.head_radius
    0.3
    """
    try:
        return ContactPair.model_validate(library.fetch("contact_pair", os.fspath(name)))
    except ValidationError as error:
        raise RailgripError(problems_of(error, ContactPair)) from None


def contact_of_pair(pair: ContactPair | str | os.PathLike[str], load: float) -> RollingContact:
    """Return the elliptic contact of a pair under a load, ready for a creep law.

    Parameters
    ----------
    pair : ContactPair, str or path
        A pair, its shipped name, or its file.
    load : float
        Normal force Q, > 0 [N].

    Returns
    -------
    RollingContact
        By Hertz's ellipse and Kalker's table.

    Raises
    ------
    RailgripError
        From `contact_pair`, `ContactPair.geometry` and `rolling_contact`.

    Examples
    --------
    >>> round(contact_of_pair("cone_on_head", 100e3).a * 1e3, 6)
    7.191978
    """
    found = pair if isinstance(pair, ContactPair) else contact_pair(pair)
    return rolling_contact(load, *found.geometry())


def rectangle_of_pair(pair: ContactPair | str | os.PathLike[str], load: float) -> RectangularPatch:
    """Return the rectangular patch of a pair with a worn rail under a load.

    Parameters
    ----------
    pair : ContactPair, str or path
        A pair with ``worn_width``, its shipped name, or its file.
    load : float
        Normal force Q, > 0 [N].

    Returns
    -------
    RectangularPatch
        Half-length, width, greatest pressure.

    Raises
    ------
    RailgripError
        "the patch of this pair is an ellipse, not a rectangle"; from `contact_pair` and
        `rectangular_patch`.

    Examples
    --------
    >>> round(rectangle_of_pair("cone_on_worn_rail", 100e3).a * 1e3, 3)
    5.07
    """
    found = pair if isinstance(pair, ContactPair) else contact_pair(pair)
    width = found.rail.worn_width
    if width is None:
        raise RailgripError(
            Problem(
                "",
                "the patch of this pair is an ellipse, not a rectangle",
                got=found.title,
                cure="contact_of_pair, or a pair with a worn_width",
            )
        )
    return rectangular_patch(load, found.wheel.radius, width, found.young, found.poisson)
