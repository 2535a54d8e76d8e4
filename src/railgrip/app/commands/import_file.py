"""`railgrip import`: lines and trains of other programs as TOML."""

from __future__ import annotations

from pathlib import Path

from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError


def import_file(file: Path, /, *, out: Path | None = None, track: list[str] | None = None) -> int:
    """Read a line, train or timetable of another program and write it as TOML.

    Known are TTOBench and OSRD (JSON), railtoolkit (YAML), railML 2 and 3 (XML), and CSV.

    Parameters
    ----------
    file
        The file to read.
    out
        Where to write; FILE.toml in this folder if not given. Never overwrites.
    track
        Track, path or sections to take, in order, where a file holds several; or the traction
        mode, or the vehicles of a formation.
    """
    import tomli_w

    from railgrip.io.importing import read_any

    found = read_any(file, track)
    target = out or Path(f"{file.stem}.toml")
    if target.exists():
        raise RailgripError(Problem(str(target), "is there already", cure="another name: --out"))
    with write_aside(target) as aside:
        head = f"# {found.kind} from {file.name} ({found.format}); SI units\n"
        aside.write_text(head + tomli_w.dumps(found.table), encoding="utf-8")
    print(f"{found.format}: {found.summary}\n{target}")
    return 0
