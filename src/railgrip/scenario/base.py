"""What every model of a scenario shares: frozen, no unknown keys, lists with ``count``."""

from __future__ import annotations

from typing import Annotated, Any, TypeVar

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, StringConstraints
from pydantic_core import PydanticCustomError

from railgrip.core.errors import Problem

Item = TypeVar("Item", bound="Counted")

Text = Annotated[str, StringConstraints(max_length=2000)]
Name = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$", max_length=80)]


class Model(BaseModel):
    """A frozen description; a key that is not known is refused."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", populate_by_name=True, serialize_by_alias=True
    )


class Counted(Model):
    """An entry of a list that may stand for several alike."""

    count: int = Field(
        default=1, ge=1, le=1000, description="How many alike stand here, one after another."
    )


def repeat(items: tuple[Item, ...]) -> tuple[Item, ...]:
    """Replace each entry with ``count`` n by n entries with count 1 (one object, n times)."""
    spread: list[Item] = []
    for item in items:
        alone = item if item.count == 1 else item.model_copy(update={"count": 1})
        spread.extend([alone] * item.count)
    return tuple(spread)


Repeated = AfterValidator(repeat)
"""Marks a tuple of `Counted` entries: held with every count spread out."""


def places(items: tuple[Any, ...]) -> list[tuple[int, Any]]:
    """Return (index in the file, entry) of the entries that `repeat` spread out."""
    found: list[tuple[int, Any]] = []
    for item in items:
        if not found or found[-1][1] is not item:
            found.append((len(found), item))
    return found


def refusal(problems: list[Problem]) -> PydanticCustomError:
    """Return the error that carries problems to `explain`, each ``where`` relative to here."""
    text = "; ".join(str(problem) for problem in problems)
    return PydanticCustomError("railgrip_problems", "{text}", {"text": text, "problems": problems})


def refuse(problems: list[Problem]) -> None:
    """Raise what a cross check found; nothing if it found nothing."""
    if problems:
        raise refusal(problems)
