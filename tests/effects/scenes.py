"""The scenes of scenes.txt, and their files."""
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
# One sample: what effects of shading cost does not drown in that of edges.
SIZE = ["--size", "192x144", "--samples", "1"]


def rows():
    """{name: (model, options)} in the file's order."""
    found = {}
    with open(os.path.join(FOLDER, "scenes.txt")) as file:
        for line in file:
            if line.strip() and not line.startswith("#"):
                name, model, options = (cell.strip() for cell in line.split("|"))
                found[name] = (model, options.split())
    return found


def arguments(root, made, name):
    """The model's path and the options of a scene; None where the model is not on this machine."""
    model, options = rows()[name]
    top, rest = model.split("/", 1)
    path = {"made": made, "models": os.path.join(root, "models"),
            "assets": os.path.join(root, "../shared/assets/models")}[top] + "/" + rest
    return [path, *SIZE, *options] if os.path.exists(path) else None


def fail(*lines):
    print(*lines, sep="\n", file=sys.stderr)
    sys.exit(1)
