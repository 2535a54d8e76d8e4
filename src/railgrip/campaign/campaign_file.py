"""What a campaign is: a scenario, what varies in it, how it is sampled, when it ends."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, ValidationError, field_validator, model_validator

from railgrip import data
from railgrip.campaign.campaign_parts import (
    FIGURES,
    USUAL,
    Correlation,
    Design,
    Sampling,
    Until,
    Variable,
)
from railgrip.campaign.completing import (
    in_their_units,
    problems_in_file,
    until_in_its_unit,
    with_samples,
)
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.io.toml_file import load, read_toml
from railgrip.scenario import Scenario
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.files import is_path


class CampaignFile(Model):
    """A campaign as its file describes it; complete after `resolved`."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the distributions come from.")
    scenario: Any = Field(description="A shipped scenario, a file or a table.")
    changes: dict[Text, Any] = Field(default={}, alias="set", description="key = value.")
    variable: Annotated[tuple[Variable, ...], Field(max_length=500)] = Field(
        default=(), description="What varies."
    )
    correlation: Annotated[tuple[Correlation, ...], Field(max_length=100)] = Field(
        default=(), description="What goes together."
    )
    sampling: Sampling = Field(default=Sampling(), description="How runs are drawn.")
    runs: int = Field(default=1000, ge=1, le=10**10, description="At most so many.")
    until: Until | None = Field(default=None, description="End earlier, when this is known.")
    chunk: int = Field(
        default=4096, ge=16, le=65536, description="Runs in one part of the results."
    )
    keep: Annotated[tuple[Text, ...], Field(min_length=1, max_length=100)] = Field(
        default=USUAL, description="Figures of each run that are kept."
    )
    collector: Text = Field(
        default="", description="Own figures: a registered collector, or file.py:function."
    )
    design: Annotated[tuple[Design, ...], Field(max_length=1000)] = Field(
        default=(), description="Variants, all drawn alike; absent: the scenario alone."
    )
    condition: Annotated[tuple[Design, ...], Field(max_length=1000)] = Field(
        default=(), description="Conditions in which every design is tried."
    )

    @field_validator("keep")
    @classmethod
    def _are_known(cls, keep: tuple[str, ...]) -> tuple[str, ...]:
        refuse([unknown_name("", "figure", n, FIGURES) for n in keep if n not in FIGURES])
        return keep

    @model_validator(mode="after")
    def _fits_together(self) -> CampaignFile:
        labels = [variable.label.casefold() for variable in self.variable]
        problems = [
            Problem(f"variable[{i}].name", f"'{label}' is the name of another column too")
            for i, label in enumerate(labels)
            if label in labels[:i] or label in (*FIGURES, "run", "status")
        ]
        for i, correlation in enumerate(self.correlation):
            problems += self._correlated(f"correlation[{i}].variables", correlation)
        for kind, entries in (("design", self.design), ("condition", self.condition)):
            names = [entry.name for entry in entries]
            problems += [
                Problem(f"{kind}[{i}].name", f"'{name}' stands there twice")
                for i, name in enumerate(names)
                if name in names[:i]
            ]
        refuse(problems)
        return self

    def _correlated(self, where: str, correlation: Correlation) -> list[Problem]:
        known = {variable.label: variable for variable in self.variable}
        missing = [name for name in correlation.variables if name not in known]
        if missing:
            return [unknown_name(where, "variable", name, known) for name in missing]
        if len({known[name].scope for name in correlation.variables}) > 1:
            return [Problem(where, "variables of one correlation must have the same scope")]
        earlier = [name for other in self.correlation[: self.correlation.index(correlation)]
                   for name in other.variables]  # fmt: skip
        return [
            Problem(where, f"'{name}' is correlated twice; join the matrices")
            for name in correlation.variables
            if name in earlier
        ]

    def base(self) -> Scenario:
        """Return the scenario that the campaign varies."""
        scenario = load(self.scenario)
        seeded = {"run.seed": self.sampling.seed, **self.changes}
        return scenario.with_(seeded)


def read_campaign_file(source: str | os.PathLike[str]) -> CampaignFile:
    """Return the checked campaign of a TOML file or a shipped name, complete in itself.

    Raises
    ------
    RailgripError
        Every problem at once, with key paths: ``variable[0].distribution.deviation: must be more
        than 0; got -2``.

    Examples
    --------
    >>> read_campaign_file("dry_emergency").runs
    20000
    """
    word = os.fspath(source)
    path = Path(word)
    if not is_path(word) and not path.exists():
        path = data.path("campaigns", word)
    table = read_toml(path)
    return campaign_from(table, path.parent)


def campaign_from(table: dict[str, Any], folder: Path) -> CampaignFile:
    """Return the checked campaign of a table whose file names begin in a folder."""
    try:
        found = CampaignFile.model_validate(table)
    except ValidationError as error:
        raise RailgripError(problems_in_file(error, CampaignFile)) from None
    return _resolved(found, table, folder)


def _resolved(campaign: CampaignFile, table: dict[str, Any], folder: Path) -> CampaignFile:
    """Return the campaign with scenario, samples and the collector's place written out."""
    word = campaign.scenario
    if isinstance(word, str) and is_path(word):
        word = folder / word
    if not isinstance(word, (str, Path, dict)):
        raise RailgripError(Problem("scenario", "must be a name, a file or a table"))
    scenario = load(word).model_dump(mode="json", by_alias=True, exclude_unset=True)
    campaign = campaign.model_copy(update={"scenario": scenario})
    variables = in_their_units(campaign.base(), campaign.variable, table.get("variable", ()))
    collector = campaign.collector
    file, colon, function = collector.rpartition(":")
    if colon and file.endswith(".py"):
        collector = f"{os.path.abspath(folder / file)}:{function}"
    until = until_in_its_unit(campaign.until, table.get("until"))
    changes = {
        "variable": with_samples(variables, folder), "collector": collector, "until": until,
    }  # fmt: skip
    return campaign.model_copy(update=changes)
