"""summary.json and rows.json are what docs/reference/summary.schema.json and rows.schema.json say: of runs of each model, stopped, refused and predicted ones,
of a bench and a case. The schemas name every key that the sources write, and summaries that lack a key or have another are refused."""
import copy
import glob
import json
import os
import re
import subprocess
import sys
import tempfile
from debian import need

(jsonschema,) = need("python3-jsonschema", "jsonschema")
import test_resume  # its examples made small

PROGRAM, SOURCE = test_resume.PROGRAM, test_resume.SOURCE
EXAMPLES = ["ball-breaks+softening", "beams-fracture", "cells-events", "two-models", "cantilever", "cube-modes"]
BROKEN = "version: 1\nmaterials: {glass: {E: 70 GPa, nu: 0.7, density: 2500 kg/m^3}}\n"
FAILURES = []


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def load(name):
    with open(f"{SOURCE}/docs/reference/{name}.schema.json", encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft202012Validator.check_schema(schema)
    return schema


SUMMARY, ROWS = load("summary"), load("rows")


def complaints(schema, value):
    return [f"{'.'.join(map(str, error.absolute_path))}: {error.message[:200]}" for error in jsonschema.Draft202012Validator(schema).iter_errors(value)]


def properties(schema, root, path=""):
    """Path and schema of every key below; names that are the scene's are <name>."""
    while "$ref" in schema:
        schema = dict(root["$defs"][schema["$ref"].split("/")[-1]], **{key: word for key, word in schema.items() if key != "$ref"})
    found = [(path, schema)] if path else []
    for key, one in schema.get("properties", {}).items():
        found += properties(one, root, f"{path}.{key}")
    for key, mark in (("additionalProperties", ".<name>"), ("items", "")):
        if isinstance(schema.get(key), dict):
            found += [(below, one) for below, one in properties(schema[key], root, path + mark) if below != path]
    return found


def keys_of(schema, value, root, path=""):
    """Paths of the keys that a value has, as `properties` spells them."""
    while "$ref" in schema:
        schema = root["$defs"][schema["$ref"].split("/")[-1]]
    found = {path}
    for key, one in value.items() if isinstance(value, dict) else ():
        known = schema.get("properties", {})
        if key in known or isinstance(schema.get("additionalProperties"), dict):
            found |= keys_of(known.get(key, schema.get("additionalProperties")), one, root, f"{path}.{key}" if key in known else f"{path}.<name>")
    for one in value if isinstance(value, list) else ():
        found |= keys_of(schema.get("items", {}), one, root, path)
    return found


def run(*words, expected=0):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=900, check=False)
    if done.returncode != expected:
        raise SystemExit(f"result schemas: breccia {' '.join(words)} ended with {done.returncode}, expected {expected}:\n{done.stdout}{done.stderr}")


def summaries(folder):
    """(name, summary) of runs."""
    for name in EXAMPLES:
        line = test_resume.command(name, f"{folder}/{name}", test_resume.overrides(name))
        if name == "cantilever":  # what check told is in the summary of the run
            run("check", *[word for word in line[2:] if word not in ("--precision", "double")])
        run(*line[1:])
        yield name, summary_in(f"{folder}/{name}")
    with open(f"{folder}/broken.yaml", "w", encoding="utf-8") as file:
        file.write(BROKEN)
    run("run", f"{folder}/broken.yaml", "-o", f"{folder}/broken", expected=2)
    yield "broken", summary_in(f"{folder}/broken")


def summary_in(folder):
    with open(f"{folder}/summary.json", encoding="utf-8") as file:
        return json.load(file)


def the_schemas_say_what_each_key_is():
    for name, schema in (("summary", SUMMARY), ("rows", ROWS)):
        for path, one in properties(schema, schema):
            expect(path.endswith(".<name>") or len(one.get("description", "")) > 1, f"{name}.schema.json says nothing of {path}")
    expect(len(properties(SUMMARY, SUMMARY)) > 150, "few keys are found in summary.schema.json")


def summaries_are_as_the_schema_says(folder):
    met = set()
    for name, summary in summaries(folder):
        for complaint in complaints(SUMMARY, summary):
            expect(False, f"summary.json of {name}: {complaint}")
        met |= keys_of(SUMMARY, summary, SUMMARY)
    unmet = [path for path, one in properties(SUMMARY, SUMMARY) if path not in met]
    print(f"summary.json: {len(met)} keys met; not: {' '.join(unmet)}")
    for path in unmet:  # what few runs have: a mode of failure, a reason
        expect(path.endswith(("detached", "why_not")), f"no run has the key {path} of summary.schema.json")


def other_summaries_are_refused(folder):
    good = summary_in(f"{folder}/cantilever")
    wrong = []
    for change in ({"seconds": 1}, {"frames": "many"}, {"steps": -0.5}, {"commit": None}):
        wrong.append({**good, **change})
    for key in ("ledger", "end", "timing"):
        wrong.append({name: value for name, value in good.items() if name != key})
    for keys, value in ((("end", "status"), "fine"), (("ledger", "work"), 1), (("counts", "bonds"), "all")):
        other = copy.deepcopy(good)
        other[keys[0]][keys[1]] = value
        wrong.append(other)
    for k, one in enumerate(wrong):
        expect(complaints(SUMMARY, one), f"summary.schema.json takes the wrong summary {k}")


def rows_are_as_the_schema_says(folder):
    run("bench", "throughput", "--sizes", "64", "--devices", "cpu", "--threads", "1", "--precisions", "double", "--sample", "0.001", "--copy", "1", "-o", f"{folder}/bench")
    run("bench", "statics", "--sizes", "500", "--devices", "cpu", "--threads", "1", "-o", f"{folder}/statics")
    run("reproduce", "agh19-table3", "--quick", "--device", "cpu", "-o", f"{folder}/case")
    for name in ("bench", "statics", "case"):
        with open(f"{folder}/{name}/rows.json", encoding="utf-8") as file:
            rows = json.load(file)
        expect(len(rows) > 0, f"rows.json of {name} is empty")
        for complaint in complaints(ROWS, rows):
            expect(False, f"rows.json of {name}: {complaint}")
    for k, row in enumerate(({**rows[0], "ours": "1"}, {**rows[0], "two words": 1}, {key: value for key, value in rows[0].items() if key != "commit"}, {**rows[0], "more": [1]})):
        expect(complaints(ROWS, [row]), f"rows.schema.json takes the wrong row {k}")


def the_schema_of_rows_has_every_key_of_the_sources():
    asked = set()
    for path in glob.glob(f"{SOURCE}/bench/*.c") + glob.glob(f"{SOURCE}/host/commands/**/*.c", recursive=True):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        asked |= set(re.findall(r'brc_rows_(?:text|number|integer)\([^,"]+, "(\w+)"', text))
        if path.endswith("accuracy_point.c"):
            asked |= set(re.findall(r"\b(?:TEXT|NUMBER|INTEGER)\((\w+)\)[,}]", text)) - {"problem"}
    known = set(ROWS["items"]["properties"])
    expect(len(asked) > 80, f"only {len(asked)} keys of rows are found in the sources")
    expect(asked == known, f"rows.schema.json lacks {sorted(asked - known)}, and has {sorted(known - asked)}, which no source writes")


the_schemas_say_what_each_key_is()
the_schema_of_rows_has_every_key_of_the_sources()
with tempfile.TemporaryDirectory() as scratch:
    summaries_are_as_the_schema_says(scratch)
    other_summaries_are_refused(scratch)
    rows_are_as_the_schema_says(scratch)
for failure in FAILURES:
    print("result schemas: " + failure)
sys.exit(1 if FAILURES else 0)
