"""A profile: which tests, on which rail, valid when, judged by which limits.

A profile is a file, so that a user who holds a standard sets its true limits and keeps them
private: ``extends = "en_15595_style"``, then only what differs.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

from pydantic import Field, ValidationError, model_validator

from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.scenario import library
from railgrip.scenario.base import Model, Name, Text, refuse
from railgrip.scenario.explain import problems_of
from railgrip.scenario.units import Dimensionless, Length

Number = float | int | str
"""A limit as it stands in the file: with its unit, which its metric checks."""


class Window(Model):
    """Where a figure must lie."""

    least: Number | None = Field(default=None, description="Not below, with its unit.")
    greatest: Number | None = Field(default=None, description="Not above, with its unit.")
    source: Text = Field(
        min_length=1, description="Where it comes from, or 'background, unverified'."
    )

    @model_validator(mode="after")
    def _says_something(self) -> Window:
        if self.least is None and self.greatest is None:
            refuse([Problem("", "has neither least nor greatest")])
        return self


class Limit(Window):
    """What a test must keep."""

    judged: Literal["each", "mean"] = Field(
        default="each", description="Every valid run must keep it, or their mean."
    )


class Alternating(Model):
    """Rail conditions that take turns, in stretches whose lengths are drawn."""

    conditions: tuple[Text, Text] = Field(description="Two shipped rail conditions.")
    shortest: Length = Field(default=50.0, gt=0, le=1e4, description="Stretch.")
    longest: Length = Field(default=100.0, gt=0, le=1e4, description="Stretch.")
    begin: Length = Field(alias="from", default=0.0, ge=0, le=1e5, description="First stretch.")
    end: Length = Field(alias="to", default=3000.0, gt=0, le=1e5, description="Last stretch.")


class Tolerance(Model):
    """How much a repetition differs from the next: standard deviations, relative."""

    initial_speed: Dimensionless = Field(default=0.0, ge=0, le=0.1, description="Of the train.")
    pad_friction: Dimensionless = Field(default=0.0, ge=0, le=0.3, description="Of each axle.")
    valve_time: Dimensionless = Field(default=0.0, ge=0, le=0.3, description="Of each axle.")
    wheel_diameter: Dimensionless = Field(
        default=0.0, ge=0, le=0.02, description="As the controller believes it, each axle."
    )


class ProgrammeTest(Model):
    """One test of the programme."""

    title: Text = Field(min_length=1, description="In words.")
    title_de: Text = Field(default="", description="In German; absent: as title.")
    skip: bool = Field(default=False, strict=True, description="Leave it out.")
    needs: tuple[Literal["traction", "dynamic_brake", "dump_valve"], ...] = Field(
        default=("dump_valve",), description="Equipment without which it does not apply."
    )
    against: Text = Field(default="", description="Test on dry rail that it is compared with.")
    repetitions: int | None = Field(default=None, ge=1, le=100_000, description="Valid runs.")
    hold_speed: bool = Field(
        default=False, strict=True, description="A locomotive keeps the speed, whatever brakes."
    )
    alternating: Alternating | None = Field(default=None, description="Rail that changes.")
    scenario: dict[Text, Any] = Field(
        default={}, description="Tables of a scenario; run.speed may be 'v_max'."
    )
    valid: dict[Text, Window] = Field(default={}, description="Metric → when a run counts.")
    limit: dict[Text, Limit] = Field(default={}, description="Metric → what it must keep.")
    report: tuple[Text, ...] = Field(default=(), description="Metrics shown beside the limits.")


class Profile(Model):
    """A whole programme."""

    title: Text = Field(min_length=1, description="Name for people.")
    source: Text = Field(default="", description="Where the tests come from.")
    repetitions: int = Field(default=10, ge=1, le=100_000, description="Valid runs of each test.")
    tries: int = Field(
        default=30, ge=1, le=1_000_000, description="Runs after which a test is given up."
    )
    seed: int = Field(default=1, ge=0, lt=2**31, description="Of every random number.")
    tolerance: Tolerance = Field(default=Tolerance(), description="From run to run.")
    scenario: dict[Text, Any] = Field(default={}, description="Tables that all tests share.")
    cost_per_flat: float = Field(default=0.0, ge=0, le=1e9, description="In your currency.")
    flat_from: Length = Field(
        default=0.03, gt=0, le=1, description="Length from which a flat must be turned off."
    )
    metric: dict[Name, Text] = Field(
        default={}, description="Own metrics: name → file.py:function."
    )
    test: dict[Name, ProgrammeTest] = Field(min_length=1, description="By their short names.")

    @model_validator(mode="after")
    def _fits_together(self) -> Profile:
        problems = [
            Problem(f"test.{name}.against", "is no test of this profile", got=f"'{one.against}'",
                    allowed=", ".join(self.test))
            for name, one in self.test.items()
            if one.against and one.against not in self.test
        ]  # fmt: skip
        if self.tries < self.repetitions:
            problems.append(
                Problem("tries", "must not be less than repetitions",
                        got=f"{self.tries} and {self.repetitions}")
            )  # fmt: skip
        refuse(problems)
        return self

    def with_repetitions(self, repetitions: int) -> Profile:
        """Return the profile with so many valid runs of every test, and as many more tries."""
        tests = {
            name: one.model_copy(update={"repetitions": None}) for name, one in self.test.items()
        }
        tries = max(self.tries, 4 * repetitions)
        changed = {"repetitions": repetitions, "tries": tries, "test": tests}
        return self.model_copy(update=changed)

    def chosen(self, names: tuple[str, ...] = ()) -> dict[str, ProgrammeTest]:
        """Return the tests to run, in their order; with names, those and what they compare with.

        Raises
        ------
        RailgripError
            ``--test: test 'W5' unknown; known: …``
        """
        wrong = [unknown_name("--test", "test", name, self.test) for name in names
                 if name not in self.test]  # fmt: skip
        if wrong:
            raise RailgripError(wrong)
        wanted = set(names) or {name for name, one in self.test.items() if not one.skip}
        wanted |= {self.test[name].against for name in wanted if self.test[name].against}
        return {name: one for name, one in self.test.items() if name in wanted}


def read_profile(source: str) -> tuple[Profile, Path]:
    """Return a profile and the folder in which its relative file names begin.

    Parameters
    ----------
    source : str
        A shipped name (``en_15595_style``) or a TOML file.

    Raises
    ------
    RailgripError
        Every problem at once: ``test.W3.limit.extension.source: is missing; …``

    Examples
    --------
    >>> profile, _ = read_profile("en_15595_style")
    >>> "W3" in profile.test
    True
    """
    path = library.find("profile", source)
    table = library.fetch("profile", source)
    try:
        return Profile.model_validate(table), path.parent
    except ValidationError as error:
        raise RailgripError(problems_of(error, Profile, str(path.name))) from None
