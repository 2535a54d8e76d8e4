"""Where an error's place lies in the models: the model that owns it, the field, its bounds."""

from __future__ import annotations

import types
from collections.abc import Iterator
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from railgrip.scenario.quantity import Unit


def metadata(field: FieldInfo) -> Iterator[Any]:
    """Yield the bounds and the unit of a field."""
    yield from field.metadata
    for inner in unwrapped(field.annotation):
        if isinstance(inner, Unit):
            yield inner


def unwrapped(annotation: Any) -> Iterator[Any]:
    """Yield the models and units inside an annotation."""
    origin = get_origin(annotation)
    if origin is Annotated:
        base, *metadata = get_args(annotation)
        yield from unwrapped(base)
        yield from (entry for entry in metadata if isinstance(entry, Unit))
    elif origin in (Union, types.UnionType, tuple, dict):
        for argument in get_args(annotation):
            yield from unwrapped(argument)
    elif isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation


def place(
    model: type[BaseModel], loc: tuple[int | str, ...]
) -> tuple[type[BaseModel] | None, FieldInfo | None]:
    """Return the model that owns the last key of a place, and the field there."""
    owner: type[BaseModel] | None = model
    field: FieldInfo | None = None
    inner: list[type[BaseModel]] = [model]
    in_dict = False
    for part in loc:
        if isinstance(part, int):
            continue
        if in_dict:  # a name that the user chose
            in_dict = False
            continue
        if len(inner) > 1:  # told apart by a law, whose name stands in the place
            inner = [m for m in inner if part in _laws(m)]
            continue
        owner = inner[0] if inner else None
        fields = {} if owner is None else owner.model_fields
        field = next((f for name, f in fields.items() if part in (f.alias, name)), None)
        inner = (
            []
            if field is None
            else [found for found in unwrapped(field.annotation) if isinstance(found, type)]
        )
        in_dict = field is not None and get_origin(field.annotation) is dict
    return owner, field


def _laws(model: type[BaseModel]) -> tuple[Any, ...]:
    law = model.model_fields.get("law")
    return () if law is None else get_args(law.annotation)
