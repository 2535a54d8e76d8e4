"""What a user reads when something is wrong: what, got, allowed, try."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong, in the words of the person who can mend it.

    Parameters
    ----------
    where : str
        Key path, file or option, e.g. ``train.vehicle[1].brake``; may be empty.
    what : str
        What is wrong.
    got, allowed, cure : str
        What was found, what is allowed, what to try; each may be empty.

    Examples
    --------
    >>> str(Problem("run.speed", "must be positive", got="-3 km/h", cure="give e.g. '160 km/h'"))
    "run.speed: must be positive; got -3 km/h; try: give e.g. '160 km/h'"
    """

    where: str
    what: str
    got: str = ""
    allowed: str = ""
    cure: str = ""

    def __str__(self) -> str:
        head = f"{self.where}: {self.what}" if self.where else self.what
        parts = [head]
        if self.got:
            parts.append(f"got {self.got}")
        if self.allowed:
            parts.append(f"allowed: {self.allowed}")
        if self.cure:
            parts.append(f"try: {self.cure}")
        return "; ".join(parts)


class RailgripError(Exception):
    """Everything railgrip refuses, as one line a problem.

    Parameters
    ----------
    problems : Problem, list of Problem, or str
        What is wrong; a plain sentence is one problem without a place.

    Examples
    --------
    >>> str(RailgripError("the file is empty"))
    'the file is empty'
    """

    def __init__(self, problems: Problem | Iterable[Problem] | str) -> None:
        if isinstance(problems, str):
            problems = Problem("", problems)
        self.problems = [problems] if isinstance(problems, Problem) else list(problems)
        super().__init__("\n".join(str(problem) for problem in self.problems))


def nearest(word: str, known: Iterable[str]) -> str | None:
    """Return the known name that the user most likely meant, or None.

    Examples
    --------
    >>> nearest("conventionl", ["conventional", "none"])
    'conventional'
    """
    names = list(known)
    lowered = {name.lower(): name for name in names}
    found = difflib.get_close_matches(word.lower(), list(lowered), n=1, cutoff=0.6)
    return lowered[found[0]] if found else None


def unknown_name(where: str, kind: str, word: str, known: Iterable[str]) -> Problem:
    """Return the problem "this name is not known", with the known names and the nearest.

    Examples
    --------
    >>> str(unknown_name("brake", "pad", "organik", ["organic", "sinter"]))
    "brake: pad 'organik' unknown; known: organic, sinter; did you mean 'organic'?"
    """
    names = sorted(known)
    text = f"{kind} '{word}' unknown; known: {', '.join(names)}"
    guess = nearest(word, names)
    if guess:
        text += f"; did you mean '{guess}'?"
    return Problem(where, text)
