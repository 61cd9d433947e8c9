"""The first notebook runs, without Jupyter; scripts/notebooks runs all of them in its kernel."""

import json
import pathlib

import matplotlib

matplotlib.use("Agg")
FOLDER = pathlib.Path(__file__).parents[3] / "notebooks"


def test_the_first_notebook_runs(capsys):
    notebook = json.loads((FOLDER / "1_first_scan.ipynb").read_text(encoding="utf-8"))
    names = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        exec(compile("".join(cell["source"]), cell["id"], "exec"), names)
        stored = "".join("".join(output.get("text", "")) for output in cell["outputs"])
        assert capsys.readouterr().out == stored
