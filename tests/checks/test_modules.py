"""Modules of host/solver: core/, run/ and utilities/ know models and effects by their descriptors alone and name no kernel of one; models and
effects include nothing of run/."""
import os
import re
import repository

SOLVER = "host/solver/"
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+"([^"]+)"', re.M)
DESCRIPTORS = {SOLVER + "models/model.h", SOLVER + "effects/effect.h"}
BELOW = tuple(SOLVER + folder for folder in ("core/", "run/", "utilities/"))
MODULES = tuple(SOLVER + folder for folder in ("models/", "effects/"))


def targets(path, text):
    for written in INCLUDE.findall(text):
        yield written, os.path.normpath(os.path.join(os.path.dirname(path), written))


def below(files):
    return [f"{path}: includes {written}; ask the descriptor, or let it hook in" for path, text in files.items() if path.startswith(BELOW)
            for written, target in targets(path, text) if target.startswith(MODULES) and target not in DESCRIPTORS]


def above(files):
    return [f"{path}: includes {written}; what it needs of a run is in core/" for path, text in files.items() if path.startswith(MODULES)
            for written, target in targets(path, text) if target.startswith(SOLVER + "run/")]


def kernels(files):
    """Names of kernels of models and effects, in quotes, stand in the module alone."""
    names = {}
    for path, text in files.items():
        module = re.match(r"kernels/(models/\w+|effects/\w+)", path)
        if module and path.endswith(".cl"):
            for name in re.findall(r"KERNEL void\s+(?:PASS\()?(\w+)", text):
                names[name] = module.group(1)
    return [f"{path}: names the kernel {name} of {names[name]}" for path, text in files.items() if path.startswith(BELOW)
            for name in re.findall(r'"(\w+)"', text) if name in names]


sources = repository.read(r"^host/solver/.*\.(c|h)$|^kernels/.*\.cl$")
repository.finish([
    repository.report("below", below, sources, {"an effect": {SOLVER + "run/a.c": '#include "../effects/guard.h"\n'},
                                                "a model": {SOLVER + "core/a.c": '#include "../models/cbm/cbm.h"\n'}}),
    repository.report("above", above, sources, {"run": {SOLVER + "effects/contact/a.c": '#include "../../run/look.h"\n'}}),
    repository.report("kernels", kernels, sources, {"one": {"kernels/effects/gravity.cl": "KERNEL void gravity(int n)\n{\n}\n",
                                                            SOLVER + "run/a.c": 'BRC_PASS(p, "gravity", NULL);\n'}})])
