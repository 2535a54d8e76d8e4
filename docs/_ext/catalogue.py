"""Pages that are written from the package itself: glossary, scenario reference, API pages."""

from __future__ import annotations

import importlib
import pkgutil
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scenario_reference import scenario_reference

from railgrip.core.signals import SIGNALS

if TYPE_CHECKING:
    from sphinx.application import Sphinx

STOREYS = {
    "core": "Words of the trade, scalar formulas",
    "contact": "Wheel-rail laws",
    "track": "Line and rail condition",
    "brake": "Friction, heat, pneumatics",
    "control": "Controllers",
    "train": "Axle, bogie, vehicle, train",
    "scenario": "What to run",
    "laboratory": "The contact laboratory: laws over arrays, exact theory, maps",
    "engine": "From scenario to result",
    "io": "Files",
    "report": "Metrics, plots, reports",
}


def setup(app: Sphinx) -> dict[str, Any]:
    """Let the pages be written before Sphinx looks for sources."""
    app.connect("config-inited", lambda app, _config: write_pages(Path(app.confdir)))
    app.setup_extension("sphinx.ext.autodoc")
    app.connect("autodoc-process-docstring", plain_docstring, priority=400)
    app.connect("autodoc-skip-member", skip_bare_fields)
    return {"parallel_read_safe": True}


def plain_docstring(*event: Any) -> None:
    """Make docstrings safe for one page: references as a list, |x| as magnitude, not as a name."""
    lines: list[str] = event[-1]
    literal: int | None = None  # indentation of the line that opened a literal block
    for number, line in enumerate(lines):
        indentation = len(line) - len(line.lstrip())
        if literal is not None and line.strip() and indentation <= literal:
            literal = None
        if literal is None and not line.lstrip().startswith((">>>", "...")):
            line = re.sub(r"^(\s*)\.\. \[\d+\] ", r"\1#. ", line)
            line = re.sub(r"\[(\d+)\]_", r"[\1]", line)
            lines[number] = re.sub(r"\|(\w[^|`]*)\|", r"\|\1\|", line)
            if line.endswith("::"):
                literal = indentation


def skip_bare_fields(_app: Sphinx, _what: str, _name: str, member: Any, *_: Any) -> bool | None:
    """Leave out the fields of a NamedTuple, which its docstring describes already."""
    text = getattr(member, "__doc__", None) or ""
    return True if text.startswith("Alias for field number") else None


def write_pages(docs: Path) -> None:
    """Write all generated pages below docs/_generated."""
    home = docs / "_generated"
    (home / "api").mkdir(parents=True, exist_ok=True)
    put(home / "signals.inc", signals())
    put(home / "scenario.inc", scenario_reference())
    for storey, title in STOREYS.items():
        put(home / "api" / f"{storey}.md", api_page(storey, title))


def put(path: Path, text: str) -> None:
    """Write a page only when it has changed, so that Sphinx rebuilds only what it must."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def signals() -> str:
    """Return the catalogue of signals as a glossary."""
    lines = ["```{glossary}"]
    for signal in SIGNALS.values():
        over = " × ".join(("run", *signal.dims))
        symbol = f"Symbol {signal.symbol}, unit" if signal.symbol else "Unit"
        lines += [signal.name, f"  {signal.meaning} {symbol} {signal.unit}; over {over}.", ""]
    return "\n".join([*lines, "```", ""])


def api_page(storey: str, title: str) -> str:
    """Return the page of one storey: every module with what it documents."""
    package = importlib.import_module(f"railgrip.{storey}")
    lines = [f"# railgrip.{storey}: {title}", ""]
    for module in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        if not module.ispkg and "._" not in module.name:
            short = module.name.removeprefix("railgrip.")
            lines += [f"## {short}", "", "```{eval-rst}", f".. automodule:: {module.name}", "```"]
    return "\n".join([*lines, ""])
