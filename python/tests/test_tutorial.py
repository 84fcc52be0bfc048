"""The page on Python is what Python prints.

``UPDATE_DOCS=1 pytest tests/test_tutorial.py`` writes its printed blocks again.
"""

import contextlib
import io
import os
import re
from pathlib import Path

PAGE = Path(__file__).parents[2] / "docs" / "python.md"
BLOCK = re.compile(r"^```(python|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
#: Times by the clock differ.
TIME = re.compile(r"^(time +)\S+(  m?s)$", re.MULTILINE)


def timeless(text: str) -> str:
    return TIME.sub(r"\1…\2", text)


def test_the_page_prints_what_it_says(tmp_path, monkeypatch) -> None:
    page = PAGE.read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "__main__"}
    printed = ""
    blocks = 0

    def run(block: re.Match[str]) -> str:
        nonlocal printed, blocks
        language, content = block.groups()
        if language == "text":
            assert printed, f"nothing is printed before\n{content}"
            blocks += 1
            written, printed = printed, ""
            if timeless(written) == timeless(content):
                return block.group()
            return f"```text\n{written}```"
        assert not printed, f"this is printed and not told:\n{printed}"
        output = io.StringIO()
        line = page[: block.start()].count("\n") + 1
        with contextlib.redirect_stdout(output):
            exec(compile("\n" * line + content, str(PAGE), "exec"), names)
        printed = "\n".join(text.rstrip() for text in output.getvalue().splitlines())
        printed = printed and printed + "\n"
        return block.group()

    told = BLOCK.sub(run, page)
    assert not printed and blocks > 5
    if os.environ.get("UPDATE_DOCS"):
        PAGE.write_text(told, encoding="utf-8")
    else:
        assert told == page
