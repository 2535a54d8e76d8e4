"""A controller out of a file: found, or refused in one sentence."""

import pytest

from railgrip.control.controller_file import load_controller_class
from railgrip.core.errors import RailgripError

GOOD = """
class Mine:
    period = 0.01
    def reset(self, setup): return None
    def step(self, state, measured, dt): return None
"""


def refusal(path):
    with pytest.raises(RailgripError) as caught:
        load_controller_class(path)
    sentence = str(caught.value)
    assert "\n" not in sentence
    return sentence


def test_finds_the_class(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(GOOD)
    assert load_controller_class(path).__name__ == "Mine"


def test_finds_it_beside_what_the_file_imports(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(
        "from railgrip.control.conventional_wsp import ConventionalWSP\n"
        "class Mine(ConventionalWSP):\n    pass\n"
    )
    assert load_controller_class(path).__name__ == "Mine"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("x = 1\n", ["defines no controller", "no class", "step(state, measured, dt)"]),
        ("class A:\n    def reset(self, setup): ...\n", ["defines no controller", "A"]),
        (GOOD + GOOD.replace("Mine", "Other"), ["more than one controller", "Mine, Other"]),
        ("class A(:\n", ["cannot be executed", "SyntaxError", "line 1"]),
        ("\nimport no_such_module_here\n", ["ModuleNotFoundError", "line 2"]),
        ("1/0\n", ["ZeroDivisionError", "line 1"]),
    ],
)
def test_bad_files_are_refused_in_a_sentence(tmp_path, text, words):
    path = tmp_path / "mine.py"
    path.write_text(text)
    sentence = refusal(path)
    for word in words:
        assert word in sentence


def test_missing_file_and_wrong_kind(tmp_path):
    assert "no such file" in refusal(tmp_path / "absent.py")
    (tmp_path / "mine.toml").write_text("")
    assert "is no Python file" in refusal(tmp_path / "mine.toml")


def test_a_binary_file_is_refused(tmp_path):
    path = tmp_path / "mine.py"
    path.write_bytes(b"\x00\xff\xfe")
    assert "cannot be executed" in refusal(path)


def test_a_file_that_exits_is_refused(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text("raise SystemExit(3)\n")
    assert "cannot be executed" in refusal(path)
