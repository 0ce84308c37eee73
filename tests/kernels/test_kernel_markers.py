"""Markers of every array of every kernel (portable.h: OWN, GATHER, PUT, UPDATE, FLAG, SPREAD, SCATTER) against what the kernel's text does, by
clang's syntax tree: each kernel and the laws it calls are gone through with sets of names in place of numbers, which say through the
contents of which arrays an index came about. Rows that follow from the work-item alone, or from a list of own rows, are its own."""
import glob
import json
import os
import re
import shutil
import subprocess
import sys

sys.setrecursionlimit(100000)
KERNELS = os.path.join(os.environ["BRC_SOURCE_DIR"], "kernels")
# Arrays whose numbers lead to own rows: starts of rows, and lists of what the work-items go over.
TO_OWN = {"row_start", "list", "listed", "element", "other_element", "held_of", "face_start", "start", "boundary", "todo", "with_pairs", "redo", "face", "column_start"}
OF_FACES = {"place"}  # of loads on faces: the place of the element among those with faces
NOTHING = frozenset()
ITEM = frozenset([("item",)])
RAISED = ("FLAG", "SPREAD")  # written at others' rows too, and by STORE_SAME alone (raised_otherwise)
DECIDED = ("listed", "by_touch")  # constants that say which of two readings is compiled


class Value:
    """Tags of a number or pointer, and of the members of a struct. Tags: ("item",); ("from", array); ("array", name): points there;
    ("cell", key): points to a local; ("number", literal)."""
    __slots__ = ("tags", "of")

    def __init__(self, tags=NOTHING, of=None):
        self.tags, self.of = tags, of or {}

    def all(self):
        return self.tags.union(*[value.all() for value in self.of.values()])

    def joined(self, other):
        of = dict(self.of)
        for name, value in other.of.items():
            of[name] = of[name].joined(value) if name in of else value
        return Value(self.tags | other.tags, of)

    def key(self):
        return self.tags, tuple(sorted((name, value.key()) for name, value in self.of.items()))

    def member(self, name):
        return self.of[name].joined(Value(self.tags)) if name in self.of else Value(self.tags)


def parts(node):
    return [child for child in node.get("inner", []) if "kind" in child]


class Program:
    def __init__(self, tree):
        self.functions, self.members, self.names = {}, {}, {}
        for node in tree["inner"]:
            if node.get("kind") == "RecordDecl":
                self.members[node["id"]] = [field["name"] for field in parts(node) if field["kind"] == "FieldDecl"]
            elif node.get("kind") == "TypedefDecl":
                owner = self.record_in(node)
                if owner:
                    self.names[node["name"]] = self.members[owner]
            elif node.get("kind") == "FunctionDecl" and any(child["kind"] == "CompoundStmt" for child in parts(node)):
                self.functions[node["name"]] = node

    def record_in(self, node):
        for holder in (node.get("decl"), node.get("ownedTagDecl")):
            if holder and holder["id"] in self.members:
                return holder["id"]
        return next((found for found in map(self.record_in, parts(node)) if found), None)

    def accesses(self, name):
        """(array, "r" or "w", tags of the index) of a kernel."""
        self.seen, self.memo, self.cells = [set()], {}, {}
        parameters = [node for node in parts(self.functions[name]) if node["kind"] == "ParmVarDecl"]
        values = [Value(frozenset([("array", node["name"])])) if "*" in node["type"]["qualType"] else Value() for node in parameters]
        for _ in range(2):  # locals that are pointed to live outside of frames
            self.memo = {}
            self.call(name, values, True)
        return self.seen[0]

    def call(self, name, values, is_kernel=False):
        key = name, tuple(value.key() for value in values)
        if key in self.memo and not any(tag[0] == "cell" for value in values for tag in value.all()):
            result, seen = self.memo[key]
        else:
            node = self.functions[name]
            parameters = [child["id"] for child in parts(node) if child["kind"] == "ParmVarDecl"]
            frame = Frame(self, dict(zip(parameters, values)), is_kernel)
            self.seen.append(set())
            for _ in range(8):
                frame.changed = frame.left = False
                frame.statement([child for child in parts(node) if child["kind"] == "CompoundStmt"][0])
                if not frame.changed:
                    break
            seen = self.seen.pop()
            result = frame.result
            self.memo[key] = result, seen
        self.seen[-1] |= seen
        return result


class Frame:
    def __init__(self, program, values, is_kernel):
        self.program, self.values, self.is_kernel, self.result = program, values, is_kernel, Value()
        self.changed, self.left, self.item = False, False, None

    def put(self, table, key, value):
        old = table.get(key)
        new = value if old is None else old.joined(value)
        if old is None or new.key() != old.key():
            table[key] = new
            self.changed = True

    def point_to(self, key, value):
        self.put(self.program.cells, key, Value(value.all()))
        return Value(frozenset([("cell", key)]))

    # ---- statements ----
    def statement(self, node):
        kind = node["kind"]
        if kind == "DeclStmt":
            for variable in parts(node):
                if variable["kind"] == "VarDecl":
                    self.declare(variable)
        elif kind == "ReturnStmt":
            for value in parts(node):
                self.put(self.__dict__, "result", self.value(value))
        elif kind == "IfStmt" and self.decided(parts(node)[0]) is not None:
            branches, taken = parts(node)[1:], self.decided(parts(node)[0])
            for branch in branches[0 if taken else 1:][:1]:
                self.any(branch)
                self.left = branch["kind"] == "ReturnStmt" or any(child["kind"] == "ReturnStmt" for child in parts(branch))
        elif kind == "CompoundStmt":
            for child in parts(node):
                self.any(child)
                if self.left:
                    break
        else:
            children = parts(node)
            first = parts(children[0])[0] if kind == "ForStmt" and self.is_kernel and children[0]["kind"] == "DeclStmt" else None
            if first and first["name"] != "brc_mode" and self.item in (None, first["id"]):  # the loop of FOR_EACH_ITEM
                self.item = first["id"]
                self.put(self.values, first["id"], Value(ITEM))
                children = children[1:]
            for child in children:
                self.any(child)

    def any(self, node):
        if node["kind"].endswith("Stmt"):
            self.statement(node)
        else:
            self.value(node)

    def declare(self, node):
        start = [child for child in parts(node) if not child["kind"].endswith("Attr")]
        value = self.value(start[0]) if start else Value()
        self.put(self.values, node["id"], self.point_to(node["id"], value) if "[" in node["type"]["qualType"] else value)

    def decided(self, node):
        """Whether a condition holds that is a constant of the reading; None where it is not one."""
        while node["kind"] in ("ImplicitCastExpr", "ParenExpr"):
            node = parts(node)[0]
        if node["kind"] == "UnaryOperator" and node["opcode"] == "!":
            inner = self.decided(parts(node)[0])
            return None if inner is None else not inner
        if node.get("name") in DECIDED or node.get("referencedDecl", {}).get("name") in DECIDED:
            tags = list(self.value(node).all())
            if len(tags) == 1 and tags[0][0] == "number":
                return tags[0][1] != "0"
        return None

    # ---- memory ----
    def access(self, tags, mode):
        origin = frozenset(tag for tag in tags if tag[0] in ("item", "from"))
        read = NOTHING
        for tag in tags:
            if tag[0] == "array":
                self.program.seen[-1].add((tag[1], mode, origin))
                read |= origin | {("from", tag[1])}
            elif tag[0] == "cell":
                read |= self.program.cells[tag[1]].all()
        return Value(read)

    def place(self, node):
        """("variable", id, members), ("memory", tags) or ("value", value)."""
        kind, children = node["kind"], parts(node)
        if kind in ("ParenExpr", "ImplicitCastExpr", "CStyleCastExpr"):
            return self.place(children[-1])
        if kind == "DeclRefExpr":
            return "variable", node["referencedDecl"]["id"], ()
        if kind == "MemberExpr" and not node.get("isArrow"):
            base = self.place(children[0])
            if base[0] == "variable":
                return "variable", base[1], base[2] + (node["name"],)
            return ("value", base[1].member(node["name"])) if base[0] == "value" else base
        if kind == "MemberExpr" or (kind == "UnaryOperator" and node["opcode"] == "*"):
            return "memory", self.value(children[0]).all()
        if kind == "ArraySubscriptExpr":
            return "memory", self.value(children[0]).all() | self.value(children[1]).all()
        return "value", self.value(node)

    def read(self, place):
        if place[0] == "value":
            return place[1]
        if place[0] == "memory":
            return self.access(place[1], "r")
        value = self.values.get(place[1], Value()).joined(self.program.cells.get(("of", place[1]), Value()))
        for name in place[2]:
            value = value.member(name)
        return value

    def write(self, place, value):
        if place[0] == "memory":
            self.access(place[1], "w")
            for tag in place[1]:
                if tag[0] == "cell":
                    self.put(self.program.cells, tag[1], Value(value.all()))
        elif place[0] == "variable":
            for name in reversed(place[2]):
                value = Value(NOTHING, {name: value})
            self.put(self.values, place[1], value)

    # ---- expressions ----
    def value(self, node):
        kind, children = node["kind"], parts(node)
        if kind == "DeclRefExpr" and node["referencedDecl"]["kind"] in ("FunctionDecl", "EnumConstantDecl"):
            return Value()
        if kind in ("DeclRefExpr", "ArraySubscriptExpr", "MemberExpr"):
            return self.read(self.place(node))
        if kind == "IntegerLiteral":
            return Value(frozenset([("number", node["value"])]))
        if kind in ("BinaryOperator", "CompoundAssignOperator"):
            return self.binary(node, children)
        if kind == "UnaryOperator":
            return self.unary(node, children)
        if kind == "ConditionalOperator":
            taken = self.decided(children[0])
            if taken is not None:
                return self.value(children[1 if taken else 2])
            self.value(children[0])
            return self.value(children[1]).joined(self.value(children[2]))
        if kind == "CallExpr":
            return self.call(children)
        if kind == "InitListExpr":
            values = [self.value(child) for child in children]
            names = self.program.names.get(node["type"]["qualType"])
            return Value(NOTHING, dict(zip(names, values))) if names else Value(NOTHING.union(*[value.all() for value in values]))
        if kind == "AtomicExpr":
            tags = [self.value(child).all() for child in children]
            self.access(tags[0], "w")
            return Value()
        if kind in ("UnaryExprOrTypeTraitExpr", "StmtExpr"):
            assert kind != "StmtExpr", "a statement in an expression is not understood here"
            return Value()
        result = Value()
        for child in children:
            result = result.joined(self.value(child))
        return result

    def binary(self, node, children):
        operator = node["opcode"]
        right = self.value(children[1])
        if operator == "=":
            self.write(self.place(children[0]), right)
            return right
        left = self.value(children[0])
        if node["kind"] == "CompoundAssignOperator":
            both = Value(left.all() | right.all())
            self.write(self.place(children[0]), both)
            return both
        if operator == ",":
            return right
        return Value() if operator in ("<", ">", "<=", ">=", "==", "!=", "&&", "||") else Value(left.all() | right.all())

    def unary(self, node, children):
        operator = node["opcode"]
        if operator == "*":
            return self.read(self.place(node))
        if operator == "&":
            place = self.place(children[0])
            if place[0] == "variable":
                return self.point_to(("of", place[1]), self.read(("variable", place[1], ())))
            return Value(place[1]) if place[0] == "memory" else place[1]
        value = self.value(children[0])
        if operator in ("++", "--"):
            self.write(self.place(children[0]), value)
        return Value() if operator == "!" else value

    def call(self, children):
        callee = children[0]
        while callee["kind"] != "DeclRefExpr":
            callee = parts(callee)[0]
        values = [self.value(child) for child in children[1:]]
        name = callee["referencedDecl"]["name"]
        if name in self.program.functions:
            return self.program.call(name, values)
        return Value() if name == "__builtin_prefetch" else Value(NOTHING.union(*[value.all() for value in values]))


def is_foreign(kernel, origin):
    own = TO_OWN | (OF_FACES if kernel.startswith(("held_", "traction_")) else set())
    return ("item",) not in origin or bool({tag[1] for tag in origin if tag[0] == "from"} - own)


def markers_of(kernel, accesses):
    """The marker of each array that is read or written."""
    found = {}
    for array in {access[0] for access in accesses}:
        modes = {mode for name, mode, _ in accesses if name == array}
        foreign = any(is_foreign(kernel, origin) for name, _, origin in accesses if name == array)
        if "w" in modes:
            found[array] = "SCATTER" if foreign else "UPDATE" if "r" in modes else "PUT"
        else:
            found[array] = "GATHER" if foreign else "OWN"
    return found


def written_markers():
    """{kernel: {array: marker}} of the texts, passes under both names."""
    found = {}
    for name in sorted(glob.glob(f"{KERNELS}/**/*.cl", recursive=True)):
        with open(name, encoding="utf-8") as file:
            text = file.read()
        for match in re.finditer(r"KERNEL void\s+(PASS\()?(\w+)\)?\(((?:[^()]|\([^()]*\))*)\)", text):
            arrays = {array: marker for marker, array in re.findall(r"\b(OWN|GATHER|PUT|UPDATE|FLAG|SPREAD|SCATTER)\(\w+\)\s+(\w+)", match.group(3))}
            assert "*" not in match.group(3) and "GLOBAL" not in match.group(3), f"{match.group(2)}: an array without a marker"
            found[match.group(2)] = arrays
            if match.group(1):
                found[match.group(2) + "_listed"] = {**arrays, "list": "OWN"}
    return found


def raised_otherwise(text):
    """Flags that a kernel of the text writes in another way than all at once to one number."""
    findings = []
    for match in re.finditer(r"^KERNEL void\s+(?:PASS\()?(\w+)(.*?)^}", text, re.M | re.S):
        for array in re.findall(r"\b(?:FLAG|SPREAD)\(\w+\)\s+(\w+)", match.group(2)):
            if re.search(rf"\b{array}\[[^\]]*\]\s*[-+*|&]?=(?!=)", match.group(2)):
                findings.append(f"{match.group(1)}: {array} is a flag, and is written by other stores than STORE_SAME")
    return findings


def differences(written, derived):
    findings = []
    for kernel, arrays in written.items():
        for array, marker in arrays.items():
            does = derived[kernel].get(array, marker)  # what no variant of one lane touches may be marked as it likes
            if does != ("SCATTER" if marker in RAISED else marker):
                findings.append(f"{kernel}: {marker}({array}), and by its text it is {does}")
    return findings


def main():
    if not shutil.which("clang-14"):
        refused = bool(os.environ.get("BRC_NO_SKIPS"))
        print(f"SKIPPED{', but BRC_NO_SKIPS is set' if refused else ''}: no syntax tree without clang-14 (Debian package clang-14)")
        sys.exit(1 if refused else 77)
    tree = subprocess.run(["clang-14", "-std=gnu17", "-fsyntax-only", "-w", "-DBRC_PRECISION=1", "-DBRC_LANES=1", "-DBRC_SLICE=32",
                           "-DBRC_MANY_MATERIALS=1", f"-I{KERNELS}", "-include", "kernels.h", "-Xclang", "-ast-dump=json", "-x", "c",
                           "/dev/null"], capture_output=True, check=True).stdout
    program = Program(json.loads(tree))
    written = written_markers()
    derived = {kernel: markers_of(kernel, program.accesses(kernel)) for kernel in written}
    arrays = sum(len(arrays) for arrays in written.values())
    wrong = {"dlsm_gradient": {"displacement": "OWN", "gradient": "PUT"}, "advance": {"velocity": "PUT", "mass": "GATHER"}}
    assert len(differences(wrong, derived)) == 3, "a wrong marker is not found"
    texts = [open(name, encoding="utf-8").read() for name in sorted(glob.glob(f"{KERNELS}/**/*.cl", recursive=True))]
    bad = "KERNEL void raise(int n, FLAG(int) touched)\n{\n    FOR_EACH_ITEM(e, n) { touched[e] = 2; }\n}\n"
    assert len(raised_otherwise(bad)) == 1, "a flag that is stored to is not found"
    findings = differences(written, derived) + [finding for text in texts for finding in raised_otherwise(text)]
    for finding in findings:
        print("markers:", finding)
    print(f"{len(written)} kernels, {arrays} arrays")
    assert len(written) > 150 and arrays > 1000
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    main()
