"""Every snippet of the page runs, one after the other, and prints what the page says."""

import re
from pathlib import Path

PAGE = Path(__file__).parent.parent / "README.md"


def test_snippets_run_from_first_to_last(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    text = PAGE.read_text(encoding="utf-8")
    snippets = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    names: dict[str, object] = {}
    for snippet in snippets:
        exec(compile(snippet, PAGE.name, "exec"), names)
    printed = capsys.readouterr().out.replace("-0.", "0.").splitlines()
    assert printed[0] == re.search("It prints `(.*)`", text)[1]
    promised = re.findall(r"^print.*[^#]# (\S.*?)(?:: two.*)?$", text, re.MULTILINE)
    promised = [line for line in promised if not line.startswith("tunnel,")]
    assert len(promised) == 6 and set(promised) <= set(printed)
    assert "tunnel [[" in "\n".join(printed)
