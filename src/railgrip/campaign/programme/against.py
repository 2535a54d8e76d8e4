"""Two protocols side by side: which limits are newly missed, which are now kept."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NamedTuple

from railgrip.campaign.programme.protocol import FORM
from railgrip.campaign.programme.verdict import MISSED
from railgrip.core.errors import Problem, RailgripError


class Difference(NamedTuple):
    """One limit of one test under both.

    Attributes
    ----------
    test, metric, label, label_de, unit : str
        Which.
    before, after : float, str or None
        What was judged, in `unit`.
    verdict_before, verdict_after : str
        Of each.
    """

    test: str
    metric: str
    label: str
    label_de: str
    unit: str
    before: Any
    after: Any
    verdict_before: str
    verdict_after: str

    @property
    def is_newly_missed(self) -> bool:
        """Whether the limit is missed after, and was not before."""
        return self.verdict_after == MISSED and self.verdict_before != MISSED


def compared(before: dict[str, Any], after: dict[str, Any]) -> list[Difference]:
    """Return every limit that both protocols judged.

    Parameters
    ----------
    before, after : dict
        Tables of `protocol`.
    """
    limits = {
        (test["name"], limit["metric"]): limit for test in before["tests"]
        for limit in test["limits"]
    }  # fmt: skip
    return [
        Difference(
            test["name"], limit["metric"], limit["label"], limit["label_de"], limit["unit"],
            old["value"], limit["value"], old["verdict"], limit["verdict"],
        )
        for test in after["tests"]
        for limit in test["limits"]
        if (old := limits.get((test["name"], limit["metric"]))) is not None
    ]  # fmt: skip


def read_protocol(path: Path) -> dict[str, Any]:
    """Return the table of a protocol that was written earlier.

    Raises
    ------
    RailgripError
        ``before.json: is no protocol of railgrip; …``
    """
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise RailgripError(
            Problem(str(path), "cannot be read", got=error.strerror or "")
        ) from None
    except ValueError:
        raise RailgripError(Problem(str(path), "is no JSON file")) from None
    if not isinstance(table, dict) or "tests" not in table or "form" not in table:
        raise RailgripError(
            Problem(str(path), "is no protocol of railgrip", cure="protocol.json of qualify")
        )
    if table["form"] != FORM:
        raise RailgripError(
            Problem(str(path), "is the protocol of another version", got=f"form {table['form']}",
                    allowed=f"form {FORM}", cure="run it again")
        )  # fmt: skip
    return table
