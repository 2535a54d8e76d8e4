"""A description that a reader put together, checked as if it stood in a scenario file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from railgrip.core.errors import RailgripError
from railgrip.scenario.base import Model
from railgrip.scenario.explain import problems_of

Checked = TypeVar("Checked", bound=Model)


def checked(model: type[Checked], description: dict[str, Any], path: Path) -> Checked:
    """Return the model of a description; what is wrong names the file and the key."""
    try:
        return model.model_validate(description)
    except ValidationError as error:
        raise RailgripError(
            replace(problem, where=f"{path}: {problem.where}")
            for problem in problems_of(error, model)
        ) from None
