"""Modules of host/solver: core/, run/ and utilities/ know models and effects by their descriptors alone and name no kernel of one; models and
effects include nothing of run/. What a folder keeps is in its X_internal.h or in a source: others include no such header, tests neither, and the struct
of a simulation names each as a pointer to a struct that they alone define. Headers for all define values: they hold no passes."""
import os
import re
import repository

SOLVER = "host/solver/"
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+"([^"]+)"', re.M)
DESCRIPTORS = {SOLVER + "models/model.h", SOLVER + "effects/effect.h"}
PASSED = {SOLVER + "core/passes.h", SOLVER + "models/model.h"}  # a table of passes to be made, and what models are given and give of them
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


def internal(files):
    """A header X_internal.h is included from its own folder and the folders in it."""
    return [f"{path}: includes {written}, which is for the files of {os.path.dirname(target)}/" for path, text in files.items()
            for written, target in targets(path, text) if target.endswith("_internal.h") and not path.startswith(os.path.dirname(target) + "/")]


def shared(files):
    """What the struct of a simulation points to is defined where only its own folder sees it; nobody but core/ and run/ sets what all read."""
    body = re.search(r"struct brc_simulation \{(.*?)\n\};", repository.code_of(files.get(SOLVER + "core/solver.h", "")), re.S)
    if not body:
        return ["core/solver.h: no struct of a simulation"]
    head, _, own = body.group(1).partition("struct ")
    findings = []
    for name in re.findall(r"(\w+) \*", own):
        for path, text in files.items():
            if path.endswith(".h") and not path.endswith("_internal.h") and re.search(r"struct %s\s*\{" % name, text):
                findings.append(f"{path}: defines struct {name}; it is for {os.path.dirname(path)}/ alone: X_internal.h")
    facts = "|".join(re.findall(r"(\w+);", head))
    for path, text in files.items():
        if path.startswith(SOLVER) and not path.startswith((SOLVER + "core/", SOLVER + "run/")):
            for fact in re.findall(r"\bs->((?:%s)(?:\.\w+)?)\s*[-+*/|]?=[^=]" % facts, repository.code_of(text)):
                findings.append(f"{path}: sets s->{fact}, which all read")
    return findings


def launched(files):
    """A header for all defines values, descriptors and requests: what holds passes, and so launches, is for the files of its folder."""
    return [f"{path}: struct {name} holds passes; define it in an X_internal.h or a source" for path, text in files.items()
            if path.startswith(SOLVER) and path.endswith(".h") and not path.endswith("_internal.h") and path not in PASSED
            for name, body in re.findall(r"struct (\w+)\s*\{(.*?)\n\}", repository.code_of(text), re.S) if re.search(r"\bbrc_pass\b", body)]


def kernels(files):
    """Names of kernels of models, in quotes, stand in the model alone; core/, run/ and utilities/ name none of an effect either."""
    names = {}
    for path, text in files.items():
        module = re.match(r"kernels/(models/\w+|effects/\w+)", path)
        if module and path.endswith(".cl"):
            for name in re.findall(r"KERNEL void\s+(?:PASS\()?(\w+)", text):
                names[name] = module.group(1)
    return [f"{path}: names the kernel {name} of {names[name]}" for path, text in files.items() if path.startswith(SOLVER)
            for name in re.findall(r'"(\w+)"', text) if name in names and not path.startswith(SOLVER + names[name] + "/")
            and (path.startswith(BELOW) or names[name].startswith("models/"))]


solver = repository.read(r"^(host|preprocess|tests)/.*\.(c|h|cc)$")
simulation = {SOLVER + "core/solver.h": "struct brc_simulation {\n    brc_wants wants;\n    struct brc_own *own;\n};\n"}
sources = repository.read(r"^host/solver/.*\.(c|h)$|^kernels/.*\.cl$")
repository.finish([
    repository.report("internal", internal, solver, {"a model": {SOLVER + "statics/a.c": '#include "../models/cbm/cbm_internal.h"\n'},
                                                     "a test": {"tests/solver/a.c": '#include "../../host/solver/run/run_internal.h"\n'}}),
    repository.report("shared", shared, solver, {"a struct": dict(simulation, **{SOLVER + "effects/own.h": "struct brc_own {\n    int n;\n};\n"}),
                                                 "a fact": dict(simulation, **{SOLVER + "effects/own.c": "s->wants.n = 1;\n"})}),
    repository.report("launched", launched, solver, {"rings": {SOLVER + "core/a.h": "typedef struct brc_a {\n    struct brc_pass *spread;\n} brc_a;\n"}}),
    repository.report("below", below, sources, {"an effect": {SOLVER + "run/a.c": '#include "../effects/guard.h"\n'},
                                                "a model": {SOLVER + "core/a.c": '#include "../models/cbm/cbm_internal.h"\n'}}),
    repository.report("above", above, sources, {"run": {SOLVER + "effects/contact/a.c": '#include "../../run/look.h"\n'}}),
    repository.report("kernels", kernels, sources, {
        "an effect": {"kernels/effects/gravity.cl": "KERNEL void gravity(int n)\n{\n}\n", SOLVER + "run/a.c": 'BRC_PASS(p, "gravity", NULL);\n'},
        "a model": {"kernels/models/cbm/cbm.cl": "KERNEL void cbm_force(int n)\n{\n}\n",
                    SOLVER + "effects/a.c": 'BRC_PASS(p, "cbm_force", NULL);\n'}})])
