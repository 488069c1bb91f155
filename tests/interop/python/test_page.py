"""docs/python.md and the notebooks of docs/notebooks: their files are written and their lines run, one after the other, in
folders of their own. The last line of a cell is shown as a notebook would show it."""

import ast
import json
import os
import re
import tempfile
import unittest
from pathlib import Path
from typing import Any

PAGE = Path(__file__).resolve().parents[3] / "docs" / "python.md"
FENCE = re.compile(r"^```(\w+)([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class Page(unittest.TestCase):
    def test_it_runs(self) -> None:
        before = os.getcwd()
        scope: dict[str, Any] = {}
        pieces = 0
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for language, name, text in FENCE.findall(PAGE.read_text(encoding="utf-8")):
                    if language == "json":
                        Path(name.strip()).write_text(text, encoding="utf-8")
                    elif language == "python":
                        exec(compile(text, str(PAGE), "exec"), scope)
                        pieces += 1
            finally:
                os.chdir(before)
        self.assertGreaterEqual(pieces, 5)

    def test_notebooks_run(self) -> None:
        notebooks = sorted((PAGE.parent / "notebooks").glob("*.ipynb"))
        self.assertGreaterEqual(len(notebooks), 3)
        before = os.getcwd()
        for notebook in notebooks:
            with self.subTest(notebook=notebook.name), tempfile.TemporaryDirectory() as folder:
                os.chdir(folder)
                try:
                    run_notebook(notebook)
                finally:
                    os.chdir(before)


def run_notebook(path: Path) -> None:
    scope: dict[str, Any] = {}
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]), path.name)
        last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, path.name, "exec"), scope)
        if isinstance(last, ast.Expr):
            shown = eval(compile(ast.Expression(last.value), path.name, "eval"), scope)
            show = getattr(shown, "_repr_html_", None)
            assert show() if show is not None else repr(shown)


if __name__ == "__main__":
    unittest.main()
