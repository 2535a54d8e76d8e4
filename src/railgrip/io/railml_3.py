"""Net elements of railML 3: their lengths, and what lies where on them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NoReturn

from railgrip.core.errors import Problem, RailgripError

LOCATED = ("gradientCurve", "speedSection", "horizontalCurve")
"""What is located on net elements."""
_KEYS = {
    "gradientCurve": ("gradient",),
    "speedSection": ("maxSpeed", "vMax"),
    "horizontalCurve": ("radius",),
}


class NetElements:
    """Collects the elements of a railML 3 file as they pass by."""

    def __init__(self, file: Path) -> None:
        self.file = file
        self._lengths: dict[str, float] = {}
        self._spans: dict[str, float] = {}
        self._zeros: dict[str, dict[str, tuple[float, float]]] = {}
        self._located: dict[str, dict[str, list[tuple[float, float]]]] = {}

    def take(self, tag: str, element: Any) -> bool:
        """Note an element; return whether it is one that counts here, and may be forgotten."""
        if tag == "netElement":
            name = element.get("id", "")
            own = element.get("length")
            self._lengths[name] = 0.0 if own is None else number(self.file, element, "length")
            self._zeros[name] = _zeros(self.file, element)
        elif tag == "track":
            self._take_length(element)
        elif tag in LOCATED:
            self._take_located(tag, element)
        else:
            return False
        return True

    def rows(self) -> list[tuple[str, float, list[list[tuple[float, float]]]]]:
        """Return name, length, and gradients, speeds and radii of each element with a length."""
        found = []
        for name, own in self._lengths.items():
            parts = self._located.get(name, {})
            length = own or self._spans.get(name, 0.0)
            if length > 0.0:
                found.append((name, length, [sorted(parts.get(tag, [])) for tag in LOCATED]))
        return found

    def _take_length(self, element: Any) -> None:
        """Note the length that a track gives to the one net element it lies on."""
        length = element.find("{*}length")
        places = element.findall("{*}linearLocation/{*}associatedNetElement")
        if length is not None and len(places) == 1:
            self._spans[places[0].get("netElementRef", "")] = number(self.file, length, "value")

    def _take_located(self, tag: str, element: Any) -> None:
        """Note where a gradient, speed or radius begins on each net element it lies on."""
        key = next((key for key in _KEYS[tag] if element.get(key) is not None), None)
        if key is None or element.get("isTemporary") == "true":
            return
        value = number(self.file, element, key)
        for location in element.iterfind("{*}linearLocation"):
            if location.get("applicationDirection") == "reverse":
                continue
            for place in location.iterfind("{*}associatedNetElement"):
                name = place.get("netElementRef", "")
                at = _begin(self.file, place, self._zeros.get(name, {}))
                self._located.setdefault(name, {}).setdefault(tag, []).append((at, value))


def _zeros(file: Path, element: Any) -> dict[str, tuple[float, float]]:
    """Return by positioning system the measure at a net element's beginning, and its direction."""
    ends: dict[str, dict[float, float]] = {}
    for one in element.iterfind(".//{*}intrinsicCoordinate"):
        along = number(file, one, "intrinsicCoord")
        for place in one.iterfind("{*}linearCoordinate"):
            system = place.get("positioningSystemRef", "")
            ends.setdefault(system, {})[along] = number(file, place, "measure")
    return {
        system: (measures[0.0], -1.0 if measures.get(1.0, measures[0.0]) < measures[0.0] else 1.0)
        for system, measures in ends.items()
        if 0.0 in measures
    }


def _begin(file: Path, place: Any, zero: Mapping[str, tuple[float, float]]) -> float:
    """Return where something begins on a net element, m from its beginning."""
    for key in ("posBegin", "fromPos", "pos"):
        if place.get(key) is not None:
            return number(file, place, key)
    begin = place.find("{*}linearCoordinateBegin")
    system = "" if begin is None else begin.get("positioningSystemRef", "")
    if begin is None or system not in zero:
        return 0.0
    measure, sign = zero[system]
    return max(sign * (number(file, begin, "measure") - measure), 0.0)


def number(file: Path, element: Any, key: str, text: str | None = None) -> float:
    """Return an attribute as a number, or refuse it."""
    text = element.get(key) if text is None else text
    try:
        number = float(text)
    except (TypeError, ValueError):
        number = float("nan")
    if not abs(number) < 1e9:
        tag = element.tag.rpartition("}")[2]
        refuse(file, f"{tag}.{key}: must be a number", got=repr(text)[:60])
    return number


def refuse(file: Path, what: str, got: str = "", allowed: str = "", cure: str = "") -> NoReturn:
    """Raise what is wrong with a file."""
    raise RailgripError(Problem(str(file), what, got, allowed, cure))
