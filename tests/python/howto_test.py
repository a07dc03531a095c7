# SPDX-License-Identifier: GPL-3.0-or-later
"""The snippets of docs/howto/use-from-python.md run as they stand, one after the other, from an empty folder that
holds the scenes."""
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

source = Path(os.environ["TUNICA_SOURCE"])


class Howto(unittest.TestCase):
    def test_snippets_run(self):
        text = (source / "docs/howto/use-from-python.md").read_text()
        snippets = re.findall(r"^```python\n(.*?)^```", text, re.S | re.M)
        self.assertGreater(len(snippets), 3)
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(source / "scenes", Path(folder) / "scenes")
            os.chdir(folder)
            subprocess.run([os.environ["TUNICA_PROGRAM"], "sweep", "scenes/cylinder.toml", "--vary",
                            "outlet.resistance=8e5:1.2e6:3", "--out", "results/cylinder-sweep"], check=True,
                           capture_output=True)
            names = {}
            for snippet in snippets:
                with self.subTest(snippet=snippet):
                    exec(compile(snippet, "use-from-python.md", "exec"), names)
            os.chdir("/")


if __name__ == "__main__":
    unittest.main()
