"""Who names a model: nobody in host/, bench/ and preprocess/ but its folder in host/solver/models/, which knows no other."""
import re
import repository

MODELS = "host/solver/models/"
NAMED = re.compile(r"\bBRC_MODEL_[A-Z_]+\b|\bbrc_(is|wants)_(dlsm|published|cbm|beams)\b")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+"([^"]+)"', re.M)
REGISTRY = "host/scene/models.def"  # a line each


def predicates(files):
    findings = []
    for path, text in files.items():
        if path.startswith(MODELS) or path == REGISTRY:
            continue
        found = NAMED.findall(repository.code_of(text))
        if found:
            findings.append(f"{path}: names a model {len(found)} times; ask its descriptor ({MODELS}model.h)")
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
            if other and other != own:
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
