"""`breccia schema` is a JSON Schema that takes every example and every case of the repository, and refuses what the reader refuses about keys, words and shapes."""
import copy
import glob
import json
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import debian

yaml, jsonschema = debian.need("python3-yaml python3-jsonschema", "yaml", "jsonschema")
PROGRAM = os.path.abspath(os.environ.get("BRC_PROGRAM", "build/bin/breccia"))
SOURCE = os.path.abspath(os.environ.get("BRC_SOURCE_DIR", "."))


class Loader(yaml.SafeLoader):
    """YAML 1.2 as scenes are: on, off, yes and no are words, 1:30 is no number, dates are texts."""


Loader.yaml_implicit_resolvers = {}
for tag, words, first in (("bool", r"^(true|false)$", "tf"), ("int", r"^[-+]?[0-9]+$", "-+0123456789"),
                          ("float", r"^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$", "-+.0123456789")):
    Loader.add_implicit_resolver(f"tag:yaml.org,2002:{tag}", re.compile(words), list(first))

text = subprocess.run([PROGRAM, "schema"], capture_output=True, text=True, check=True).stdout
schema = json.loads(text)
Validator = jsonschema.Draft202012Validator
Validator.check_schema(schema)
validator = Validator(schema)


def load(path):
    with open(path, encoding="utf-8") as file:
        return yaml.load(file, Loader)


def complaints(scene):
    error = jsonschema.exceptions.best_match(validator.iter_errors(scene))
    return [f"{'.'.join(map(str, error.absolute_path))}: {error.message[:200]}"] if error else []


failures = []
scenes = sorted(glob.glob(f"{SOURCE}/examples/*/*.yaml"))
assert len(scenes) >= 20, scenes
for path in scenes:
    failures += [f"{path}: {words}" for words in complaints(load(path))]

# A scene with all its defaults, as the program writes it, is one too.
written = subprocess.run([PROGRAM, "check", "--all", "--estimate", f"{SOURCE}/examples/tension/scene.yaml"], capture_output=True, text=True, check=True).stdout
failures += [f"resolved: {words}" for words in complaints(yaml.load(written[:written.rindex("\nbody ")], Loader))]

good = load(f"{SOURCE}/examples/branching/scene.yaml")


def set_at(scene, keys, value):
    for key in keys[:-1]:
        scene = scene[key]
    if value is None:
        del scene[keys[-1]]
    else:
        scene[keys[-1]] = value


# What is wrong with the key, a value, or its absence (None); the reader refuses each.
WRONG = [(["stagse"], []), (["version"], None), (["version"], 2), (["materials"], {}), (["bodies"], {}), (["bodies", 0, "shape"], {"boxx": {}}),
         (["bodies", 0, "shape"], {"box": {"size": ["1 m", "1 m"]}}), (["bodies", 0, "shape"], {"box": {"size": ["1 m"] * 3}, "sphere": {"radius": "1 m"}}),
         (["stages", 0, "solver"], "statics"), (["accuracy"], 2), (["gravity"], [0, 0, -9.81]), (["materials", "a b"], good["materials"]["glass"]),
         (["materials", "glass", "E"], 70e9), (["materials", "glass", "E"], "70e9"), (["model"], "dslm"), (["stages", 0, "solver"], {"static": {"increments": "two"}})]
for keys, value in WRONG:
    scene = copy.deepcopy(good)
    set_at(scene, keys, value)
    if not complaints(scene):
        failures.append(f"{'.'.join(map(str, keys))}: {value} is taken")
    with open("wrong.yaml", "w", encoding="utf-8") as file:
        json.dump(scene, file)
    if subprocess.run([PROGRAM, "check", "--estimate", "wrong.yaml"], capture_output=True, check=False).returncode != 2:
        failures.append(f"the reader takes {'.'.join(map(str, keys))}: {value}")
os.remove("wrong.yaml")
short = copy.deepcopy(good)
short["accuracy"], short["budget"] = 0.01, "10 min"
if not complaints(short):
    failures.append("accuracy and budget together are taken")
print(f"{len(scenes)} scenes, {len(schema['$defs'])} sections, {len(WRONG)} wrong scenes")
if failures:
    sys.exit("\n".join(failures))
