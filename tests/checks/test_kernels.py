"""The style of kernels: laws take and give values, precision is one switch."""
import collections
import re
import repository

# portable.h asks which compiler reads it; vec.h and records.h load and store; convex_*.h clip polygons, which takes private arrays, and walk
# along faces; the last two list the kernels.
NOT_LAWS = {"kernels/kernels.h", "kernels/core/portable.h", "kernels/core/vec.h", "kernels/core/records.h"} | {
    f"kernels/effects/contact/convex_{name}.h" for name in ("body", "overlap", "wall", "sphere")}
POINTER = re.compile(r"\b(?:lane(?:_\w+)?|coeff|state|int|uint|char|void|brc_\w+)\s*(?:const\s*)?\*|->|\bGLOBAL\b|"
                     r"(?<![&\w\s])\s*&\s*(?=[A-Za-z_])(?!&)")
LITERAL = re.compile(r"(?<![\w.])(?:\d+\.\d*|\.\d+|\d+(?=[eE]))(?:[eE][+-]?\d+)?(\w?)")


def each_code_line(files):
    for path, text in files.items():
        for number, line in enumerate(repository.code_of(text).split("\n"), 1):
            yield path, number, line


def laws(files):
    findings = []
    for path, number, line in each_code_line(files):
        if path in NOT_LAWS or not path.endswith(".h"):
            continue
        directive = re.match(r"\s*#\s*(\w+)", line)
        if directive:
            guard = re.search(r"\bBRC_KERNELS_\w+_H\b", line)
            if directive.group(1) not in ("include", "define", "undef", "endif") and not guard:
                findings.append(f"{path}:{number}: #{directive.group(1)} in a law; only portable.h asks who reads it")
            continue
        if POINTER.search(line):
            findings.append(f"{path}:{number}: a pointer in a law; laws take and give values: {line.strip()}")
        if "[" in line:
            findings.append(f"{path}:{number}: an index in a law: {line.strip()}")
    return findings


def without_casts(text):
    """The code with REAL(...) and STATE(...) and casts of one literal taken out, parentheses balanced."""
    text = re.sub(r"\((?:real|coeff|state|lane)\)\s*-?[\d.]+(?:[eE][+-]?\d+)?", "()", text)
    out = []
    k = 0
    for match in re.finditer(r"\b(?:REAL|STATE)\s*\(", text):
        if match.start() < k:
            continue
        out.append(text[k:match.start()])
        depth, k = 1, match.end()
        while depth and k < len(text):
            depth += {"(": 1, ")": -1}.get(text[k], 0)
            out.append("\n" if text[k] == "\n" else "")
            k += 1
    return "".join(out) + text[k:]


def literals(files):
    findings = []
    for path, text in files.items():
        if path == "kernels/core/portable.h":
            continue
        for number, line in enumerate(without_casts(repository.code_of(text)).split("\n"), 1):
            for match in LITERAL.finditer(line):
                findings.append(f"{path}:{number}: bare literal {match.group(0)}; write REAL({match.group(0)})")
            for word in re.findall(r"\b(?:double|float)\d*\b", line):
                findings.append(f"{path}:{number}: {word}; precision is one switch: state, coeff or lane")
    return findings


def idle(files):
    """Laws that nothing in the kernels asks for."""
    code = {path: repository.code_of(text) for path, text in files.items()}
    words = collections.Counter(word for text in code.values() for word in re.findall(r"\w+", text))
    return [f"{path}: nobody uses the law {name}" for path, text in code.items()
            for name in re.findall(r"^LAW \w+ (\w+)\(", text, re.M) if words[name] < 2]


def alone(files):
    """Kernels in which one work-item goes through a block of numbers or through as many as there are: on a GPU these wait one after the other."""
    findings = []
    for path, text in files.items():
        for match in re.finditer(r"^KERNEL void\s+(?:PASS\()?(\w+)(.*?)^}", repository.code_of(text), re.M | re.S):
            if "FOR_EACH_CREW" not in match.group(2):
                loops = re.findall(r"\b\w+_BLOCK\b|\bfor \(int (\w+) = [^;]*;[^;]*\b\1 < (n_\w+)", match.group(2))
                findings += [f"{path}: a work-item of {match.group(1)} goes through many numbers alone; give each block to a crew (FOR_EACH_CREW)"
                             for _ in loops[:1]]
    return findings


law_examples = {
    "pointer": {"kernels/a.h": "LAW void f(lane_mat3 *a)\n"}, "arrow": {"kernels/a.h": "a->x = b;\n"},
    "address": {"kernels/a.h": "f(&a);\n"}, "index": {"kernels/a.h": "x[3]\n"},
    "conditional": {"kernels/a.h": "#if W == 1\n#endif\n"}, "ifdef": {"kernels/a.h": "#ifdef __OPENCL_VERSION__\n#endif\n"},
}
literal_examples = {
    "plain": {"kernels/a.cl": "x = 0.5 * y;\n"}, "exponent": {"kernels/a.cl": "x = 1e-3;\n"},
    "suffix": {"kernels/a.cl": "x = 2.f;\n"}, "beside a cast": {"kernels/a.cl": "x = REAL(0.5) + 1.0;\n"},
    "type": {"kernels/a.cl": "double x = y;\n"},
}
for sound in ("x = REAL(0.5) * STATE(1e-3) + (coeff)2.5;\n", "/* 0.5 */ a.x2 = b.y + 2 * lane3;\n"):
    assert not literals({"kernels/a.cl": sound}), sound
for sound in ("x = a & 1 && b;\n", "LAW lane f(lane a, lane b) { return a * b; }\n", "#include \"vec.h\"\n"):
    assert not laws({"kernels/a.h": sound}), sound
alone_examples = {
    "block": {"kernels/a.cl": "KERNEL void f(int n_blocks)\n{\n    FOR_EACH_ITEM(b, n_blocks) { for (int i = b * A_BLOCK; i < e; ++i) s += x[i]; }\n}\n"},
    "all": {"kernels/a.cl": "KERNEL void f(int n, int n_all)\n{\n    FOR_EACH_ITEM(k, n) { for (int b = 0; b < n_all; ++b) s += x[b]; }\n}\n"},
}
for sound in ("FOR_EACH_CREW(b, n) { for (int i = b * A_BLOCK; i < e; ++i) s += x[i]; }", "FOR_EACH_ITEM(e, n_rows) { for (int c = 0; c < 3; ++c) x[c] = 0; }"):
    assert not alone({"kernels/a.cl": f"KERNEL void f(int n)\n{{\n    {sound}\n}}\n"}), sound
kernels = repository.read(r"^kernels/.*\.(h|cl)$")
repository.finish([repository.report("laws", laws, kernels, law_examples),
                   repository.report("literals", literals, kernels, literal_examples),
                   repository.report("work-items alone", alone, kernels, alone_examples),
                   repository.report("idle laws", idle, kernels, {"one": {"kernels/a.h": "LAW lane f(lane a)\n{\n    return a;\n}\n"}})])
