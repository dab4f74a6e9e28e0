# SPDX-License-Identifier: MIT
"""Runs all that the documentation of the module shows: python docs.py ROOT.

These are the examples (`>>>`) in docstrings, and each ```python block of README.md, docs and
python/README.md: those of a file in their order, in one namespace, in a folder that has nothing but
samples. A block that imports what is not installed is only compiled, and named.
"""

import ast
import contextlib
import doctest
import importlib
import importlib.util
import os
import pkgutil
import re
import sys
import tempfile
import traceback
from pathlib import Path

import loft

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def docstrings():
    """Examples in the package: how many there are, how many fail."""
    tried = failed = 0
    modules = [loft] + [importlib.import_module(found.name) for found in
                        pkgutil.walk_packages(loft.__path__, "loft.")]
    for module in modules:
        result = doctest.testmod(module, optionflags=FLAGS)
        tried, failed = tried + result.attempted, failed + result.failed
    return tried, failed


def not_installed(code):
    """The packages that a block imports in vain."""
    names = set()
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and not node.level:
            names.add(node.module)
    return sorted(name for name in {name.split(".")[0] for name in names}
                  if importlib.util.find_spec(name) is None)


def run(block, place, line, names):
    """Whether a block does what it says."""
    test = doctest.DocTestParser().get_doctest(block, names, place, place, line)
    code = "".join(example.source for example in test.examples) if test.examples else block
    missing = not_installed(code)
    if missing:
        print(f"{place}:{line}: not run, {', '.join(missing)} is not installed")
        return True
    try:
        if test.examples:
            test.globs = names
            return doctest.DocTestRunner(optionflags=FLAGS).run(test, clear_globs=False).failed == 0
        with contextlib.redirect_stdout(None):
            exec(compile("\n" * line + block, place, "exec"), names)
        return True
    except BaseException:
        traceback.print_exc()
        return False


def blocks(path):
    """Code and its line, of each ```python block."""
    text = path.read_text(encoding="utf-8")
    for found in re.finditer(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        yield found[1], text.count("\n", 0, found.start()) + 1


def markdown(path, root):
    tried = failed = 0
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(root / "samples", Path(folder, "samples"))
        os.chdir(folder)
        names = {"__name__": "__main__"}
        for block, line in blocks(path):
            tried += 1
            failed += not run(block, str(path.relative_to(root)), line, names)
        os.chdir(root)
    return tried, failed


root = Path(sys.argv[1]).resolve()
results = {"docstrings": docstrings()}
for path in [root / "README.md", *sorted(root.glob("docs/*.md")), root / "python" / "README.md"]:
    results[path.relative_to(root)] = markdown(path, root)
for what, (tried, failed) in results.items():
    print(f"{what}: {tried} tried, {failed} failed")
wanted = {"docstrings", Path("python/README.md")}
sys.exit(any(failed or (what in wanted and not tried) for what, (tried, failed) in results.items()))
