"""Who names a model: nobody in host/, bench/ and preprocess/ but its folder in host/solver/models/, which knows no other."""
import re
import repository

MODELS = "host/solver/models/"
NAMED = re.compile(r"\bBRC_MODEL_[A-Z_]+\b|\bbrc_(is|wants)_(dlsm|published|cbm|beams)\b")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+"([^"]+)"', re.M)
# Files that still do, with how often at most. The list only shrinks.
NAMES = {
    "bench/peers.c": 6,  # compares with codes of beams
    "host/commands/calibrate/strength_test.c": 1,  # the laws of beams are fitted to samples of beams
    "host/solver/laws/beam_sample.c": 1,
    "host/scene/models.def": 3,
}
# Files that include headers of a model that is not theirs. The list only shrinks.
INCLUDES = set()


def predicates(files):
    findings = []
    for path, text in files.items():
        if path.startswith(MODELS):
            continue
        found = NAMED.findall(repository.code_of(text))
        if len(found) > NAMES.get(path, 0):
            findings.append(f"{path}: names a model {len(found)} times, {NAMES.get(path, 0)} at most; ask its descriptor "
                            f"({MODELS}model.h)")
    return findings


def neighbours(files):
    """host/solver/models/X includes nothing of models/Y, and nobody else includes either."""
    findings = []
    for path, text in files.items():
        own = path[len(MODELS):].split("/")[0] if path.startswith(MODELS) and path.count("/") > 3 else None
        for written in INCLUDE.findall(text):
            inner = re.search(r"(?:^|/)models/(\w+)/", written)
            beside = re.match(r"\.\./(\w+)/", written) if own else None
            other = inner.group(1) if inner else beside.group(1) if beside else None
            if other and other != own and path not in INCLUDES:
                findings.append(f"{path}: includes {written}, which is inside of model {other}")
    return findings


sources = repository.read(r"^(host|bench|preprocess)/.*\.(c|h|cc|def)$")
repository.finish([
    repository.report("predicates", predicates, sources,
                      {"an enum": {"host/solver/a.c": "if (kind == BRC_MODEL_CBM) f();\n"},
                       "a function": {"host/solver/a.c": "if (brc_is_dlsm(s)) f();\n"}}),
    repository.report("neighbours", neighbours, sources,
                      {"beside": {MODELS + "dlsm/a.c": '#include "../cbm/cbm.h"\n'},
                       "from outside": {"host/solver/a.c": '#include "models/dlsm/dlsm.h"\n'}}),
])
