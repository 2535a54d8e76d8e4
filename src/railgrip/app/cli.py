"""The command line: `railgrip run stop.toml` and its sisters.

Exit codes: 0 done; 1 a limit was missed or the train did not stop; 2 usage or bad input;
130 interrupted; 70 a defect of railgrip itself (the only case with a traceback).
Results go to the standard output, everything else to the standard error.
"""

from __future__ import annotations

import signal
import sys
from collections.abc import Sequence
from types import FrameType
from typing import NoReturn

from cyclopts import App, CycloptsError, Parameter

from railgrip import __version__
from railgrip.app.commands.campaign import campaign
from railgrip.app.commands.campaign_safety import safety
from railgrip.app.commands.check import check
from railgrip.app.commands.compare import compare
from railgrip.app.commands.contact import contact
from railgrip.app.commands.demo import demo
from railgrip.app.commands.drive import drive
from railgrip.app.commands.etcs import etcs
from railgrip.app.commands.identify import identify
from railgrip.app.commands.import_file import import_file
from railgrip.app.commands.list_names import list_names
from railgrip.app.commands.new import new
from railgrip.app.commands.qualify import qualify
from railgrip.app.commands.replay import replay
from railgrip.app.commands.run import run
from railgrip.app.commands.schema import schema
from railgrip.app.commands.tune import tune
from railgrip.app.files import stop_when_asked
from railgrip.app.screen import print_problems
from railgrip.core.errors import Problem, RailgripError

BAD_INPUT = 2
DEFECT = 70
INTERRUPTED = 130
TERMINATED = 143

app = App(
    name="railgrip",
    help="Brake a real train on bad rail, axle by axle, and see what happens.",
    help_epilogue="A first result: railgrip demo. A scenario of your own: railgrip new my_stop.",
    version=__version__,
    default_parameter=Parameter(negative="", show_default=False),
    suppress_keyboard_interrupt=False,
)
for command in (
    demo, run, compare, qualify, campaign, replay, identify, tune, drive, etcs, contact, check, new,
    schema,
):  # fmt: skip
    app.command(command)
app.command(import_file, name="import")
app.command(list_names, name="list")
campaign.command(safety)


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run one command line and leave with its exit code."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    # A polite kill unwinds like Ctrl-C, so that unfinished files are swept up.
    signal.signal(signal.SIGTERM, _leave)
    stop_when_asked()
    sys.exit(execute(words))


def execute(words: list[str]) -> int:
    """Run one command line and return its exit code."""
    as_json = "--json" in words
    try:
        code = app(words, exit_on_error=False, print_error=False, result_action="return_value")
    except RailgripError as error:
        print_problems(error.problems, as_json, BAD_INPUT)
        return BAD_INPUT
    except CycloptsError as error:
        text = " ".join(str(error).split())
        usage = Problem("", text.rstrip("."), cure="railgrip --help, railgrip COMMAND --help")
        print_problems([usage], as_json, BAD_INPUT)
        return BAD_INPUT
    except BrokenPipeError:
        # The reader of our output has gone, as `railgrip list | head` does; nothing is wrong.
        sys.stdout = None
        return 0
    except OSError as error:
        place = str(error.filename or "")
        print_problems([Problem(place, (error.strerror or str(error)).lower())], as_json, BAD_INPUT)
        return BAD_INPUT
    except KeyboardInterrupt:
        print("interrupted; nothing half-written was left behind", file=sys.stderr)
        return INTERRUPTED
    except Exception:
        import traceback

        traceback.print_exc()
        print(
            "this is a defect of railgrip; please report it with the lines above", file=sys.stderr
        )
        return DEFECT
    return code if isinstance(code, int) else 0


def _leave(_signal: int, _frame: FrameType | None) -> NoReturn:
    raise SystemExit(TERMINATED)
