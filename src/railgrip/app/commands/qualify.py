"""`railgrip qualify`: a test programme for a wheel-slide protection, from stop to protocol."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from railgrip.app.files import folder_of_results
from railgrip.app.options import Json
from railgrip.app.screen import as_plain, print_json, print_table, working
from railgrip.core.errors import Problem, RailgripError

if TYPE_CHECKING:
    from railgrip.campaign.programme.against import Difference
    from railgrip.campaign.programme.perform import Programme

KEPT, MISSED = 0, 1


def qualify(
    train: str,
    /,
    *,
    controller: str = "conventional",
    profile: str = "en_15595_style",
    out: Path | None = None,
    test: Annotated[tuple[str, ...], Parameter(consume_multiple=True)] = (),
    repetitions: int | None = None,
    threads: int = 1,
    language: str = "en",
    pdf: bool = False,
    against: str | None = None,
    baseline: Path | None = None,
    replay: str | None = None,
    as_json: Json = False,
) -> int:
    """Run a test programme on a train's wheel-slide protection and write the protocol.

    Exit code 1: a limit was missed, or a test could not be completed; with --against or
    --baseline: a limit is newly missed.

    Parameters
    ----------
    train
        A shipped train or a file.
    controller
        A registered controller or its Python file.
    profile
        A shipped profile or a file of your own (extends = "en_15595_style").
    out
        Folder of the protocol; ./out/CONTROLLER_PROFILE if not given.
    test
        Only these tests, and those they are compared with.
    repetitions
        Valid runs of each test, instead of the profile's number.
    threads
        Threads that share the runs; no figure depends on it.
    language
        Of page and PDF: en or de.
    pdf
        Write the PDF too (extra: pdf).
    against
        Another controller, run through the same programme and compared.
    baseline
        A protocol.json of before a change, to compare with.
    replay
        TEST.NUMBER, as W3.7: run this one again and write its whole report instead.
    as_json
        Print the summary as one JSON object.
    """
    from railgrip.report.protocol.words import words

    words(language)
    if pdf:
        from railgrip.report.protocol.pdf import typesetter

        typesetter()
    with working("reading the profile"):
        programme = _programme(train, controller, profile, repetitions, threads)
    if replay is not None:
        return _replay(programme, replay, out or Path("out") / f"replay_{replay}", as_json)
    before = _before(baseline)
    table = _perform(programme, profile, test)
    if against is not None:
        other = _programme(train, against, profile, repetitions, threads)
        before = _perform(other, profile, test)
    compared = _compared(before, table)
    folder = out or Path("out") / f"{Path(controller).stem}_{Path(profile).stem}"
    files = _write(table, compared, folder, language, pdf)
    code = _exit_code(table, compared, before is not None)
    if as_json:
        print_json(_as_json(table, compared, files, code))
        return code
    _show(table, compared)
    print(f"Protocol: {files[0]}\nBeside it: {', '.join(path.name for path in files[1:])}")
    return code


def _programme(
    train: str, controller: str, profile: str, repetitions: int | None, threads: int
) -> Programme:
    from railgrip.campaign.programme.perform import Programme
    from railgrip.campaign.programme.profile import read_profile

    chosen, folder = read_profile(profile)
    if repetitions is not None:
        if repetitions < 1:
            raise RailgripError(
                Problem("--repetitions", "must be at least 1", got=str(repetitions))
            )  # fmt: skip
        chosen = chosen.with_repetitions(repetitions)
    if threads < 1:
        raise RailgripError(Problem("--threads", "must be at least 1", got=str(threads)))
    if controller.endswith(".py"):
        _keeps_the_contract(controller)
        controller = str(Path(controller).resolve())
    return Programme(chosen, folder, train, controller, threads)


def _keeps_the_contract(controller: str) -> None:
    """Refuse a controller that fails the contract on the bench, before any train runs."""
    from railgrip.campaign.controller_check import check_on_the_bench

    wrong = [one for one in check_on_the_bench(controller) if not one.passed]
    if wrong:
        raise RailgripError(
            [Problem(f"{controller}: {one.name}", one.sentence, cure="railgrip check on it")
             for one in wrong]
        )  # fmt: skip


def _perform(programme: Programme, profile: str, tests: tuple[str, ...]) -> dict[str, Any]:
    from railgrip.campaign.programme.protocol import protocol

    records = list(programme.perform(tests, _show_progress))
    return protocol(programme, records, profile)


def _show_progress(name: str, valid: int, wanted: int) -> None:
    if sys.stderr.isatty():
        print(f"\r{name}: {valid} of {wanted} valid runs   ", end="", file=sys.stderr, flush=True)
        if valid >= wanted:
            print(file=sys.stderr)
    elif valid >= wanted:
        print(f"{name}: {valid} valid runs", file=sys.stderr, flush=True)


def _before(baseline: Path | None) -> dict[str, Any] | None:
    from railgrip.campaign.programme.against import read_protocol

    return None if baseline is None else read_protocol(baseline)


def _compared(before: dict[str, Any] | None, after: dict[str, Any]) -> list[Difference]:
    from railgrip.campaign.programme.against import compared

    return [] if before is None else compared(before, after)


def _exit_code(table: dict[str, Any], compared: list[Difference], is_comparison: bool) -> int:
    if is_comparison:
        return MISSED if any(one.is_newly_missed for one in compared) else KEPT
    summary = table["summary"]
    return MISSED if summary["missed"] or summary["incomplete"] else KEPT


def _write(
    table: dict[str, Any], compared: list[Difference], folder: Path, language: str, pdf: bool
) -> list[Path]:
    from railgrip.report.protocol.page import protocol_html

    with folder_of_results(folder) as aside:
        page = protocol_html(table, language, compared)
        (aside / "protocol.html").write_text(page, encoding="utf-8")
        text = json.dumps(as_plain(table), ensure_ascii=False, allow_nan=False, indent=1)
        (aside / "protocol.json").write_text(text, encoding="utf-8")
        names = ["protocol.html", "protocol.json"]
        if pdf:
            from railgrip.report.protocol.pdf import protocol_pdf

            (aside / "protocol.pdf").write_bytes(protocol_pdf(table, language))
            names.append("protocol.pdf")
    return [folder / name for name in names]


def _show(table: dict[str, Any], compared: list[Difference]) -> None:
    from railgrip.report.protocol import cells
    from railgrip.report.protocol.words import words

    said = words("en")
    rows = []
    for test in table["tests"]:
        if test["problem"]:
            rows.append([test["name"], "", "", "", "", test["problem"][:60]])
        rows += [
            [test["name"], limit["label"], cells.bound(limit, said),
             cells.figure(limit["value"], limit["unit"], said), cells.margin(limit),
             limit["verdict"]]
            for limit in test["limits"]
        ]  # fmt: skip
    title = f"{table['identification']['controller']}: {table['identification']['profile_title']}"
    print_table(title, ["test", "figure", "limit", "measured", "margin", "verdict"], rows)
    for one in compared:
        if one.is_newly_missed:
            print(f"newly missed: {one.test}, {one.label}: {one.before} → {one.after} {one.unit}")
    print(" ".join(cells.outcome(table, said)[1]) + " Simulation, not an approval.")


def _as_json(
    table: dict[str, Any], compared: list[Difference], files: list[Path], code: int
) -> dict[str, Any]:
    return {
        "summary": table["summary"],
        "missed": [
            {"test": test["name"], **limit}
            for test in table["tests"]
            for limit in test["limits"]
            if limit["verdict"] == "missed"
        ],
        "newly_missed": [one._asdict() for one in compared if one.is_newly_missed],
        "nearest": table["nearest"],
        "files": [str(path) for path in files],
        "exit_code": code,
    }


def _replay(programme: Programme, which: str, folder: Path, as_json: bool) -> int:
    """Run one repetition again and write its report."""
    from railgrip.app import results
    from railgrip.campaign.programme.again import run_again

    name, point, number = which.rpartition(".")
    if not point or not number.isdigit():
        raise RailgripError(
            Problem("--replay", "is not of the form TEST.NUMBER", got=f"'{which}'", cure="W3.7")
        )
    with working(f"running {which} again"):
        result = run_again(programme, name, int(number))
    files = results.write(result, folder)
    if as_json:
        print_json(results.as_json(result, files))
    else:
        results.show(result, which)
        results.name_files(files)
    return results.exit_code(result)
