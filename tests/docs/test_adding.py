"""A model and an effect are added as docs/reference/adding_a_model.md and adding_an_effect.md say, in a copy of the source: the copy is built
and both give known answers, on the processor and through OpenCL. The pages show what each addition touches."""
import csv
import os
import re
import shutil
import subprocess
import sys

source, build = os.environ["BRC_SOURCE_DIR"], os.environ["BRC_BUILD_DIR"]
PARTS = os.path.join(source, "tests", "adding")
# New files, and (file, the line before, the new line).
MODEL = ({"kernels/models/spring/spring.cl": "spring.cl", "host/solver/models/spring/model.c": "spring.c", "host/scene/models/spring.c": "spring_scene.c"},
         [("host/scene/models.def", "BRC_MODEL(BRC_MODEL_CBM", 'BRC_MODEL(BRC_MODEL_SPRING, "spring", spring, "central springs")'),
          ("kernels/kernels.h", '#include "models/cbm/cbm.cl"', '#include "models/spring/spring.cl"')])
EFFECT = ({"kernels/effects/constant_drag.cl": "constant_drag.cl", "host/solver/effects/constant_drag.c": "constant_drag.c"},
          [("host/solver/effects/effects.def", "BRC_EFFECT(brc_mass_damping", "BRC_EFFECT(brc_constant_drag_effect)"),
           ("host/scene/scene.h", "    double mass_damping;", "    double constant_drag; /* [m/s^2] */"),
           ("host/scene/schema_stages.c", "static const brc_entry DYNAMIC[] = {",
            '    {"constant_drag", BRC_TYPE_QUANTITY, "m/s^2", NOT_NEGATIVE, FIELD(brc_stage, constant_drag), .given = "0", .sample = "1 m/s^2",\n'
            '     .meaning = "what every element loses of its speed"},'),
           ("kernels/kernels.h", '#include "core/motion.cl"', '#include "effects/constant_drag.cl"')])
CUBE = """version: 1
materials: {glass: {E: 1 GPa, nu: 0.25, density: 1000 kg/m^3}}
model: %s
bodies: [{name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {elements: 64, spread: 0, lloyd: 0}}, material: glass}]
stages: [{name: go, initial: [%s], solver: {dynamic: {%s}}}]
sensors: {elastic: {energy: elastic}, kinetic: {energy: kinetic}, damping: {energy: damping}, closure: {energy: closure},
          path: {point: {point: [0.5 m, 0.5 m, 0.5 m], component: x}}}
output: {frames: none, picture: false}
"""


def copy(tree):
    """The working tree without builds; files that did not change keep their time, so that a build is taken up again."""
    shutil.rmtree(tree, ignore_errors=True)
    listed = subprocess.check_output(["git", "-C", source, "ls-files", "--cached", "--others", "--exclude-standard"], text=True).splitlines()
    for path in listed:
        if not os.path.isfile(os.path.join(source, path)):
            continue
        os.makedirs(os.path.dirname(os.path.join(tree, path)), exist_ok=True)
        shutil.copy2(os.path.join(source, path), os.path.join(tree, path))


def add(tree, parts):
    """Apply; the lines of the diff stat."""
    new, lines = parts
    stat = []
    for path, part in sorted(new.items()):
        with open(os.path.join(PARTS, part), encoding="utf-8") as file:
            text = file.read()
        os.makedirs(os.path.dirname(os.path.join(tree, path)), exist_ok=True)
        with open(os.path.join(tree, path), "w", encoding="utf-8") as file:
            file.write(text)
        stat.append((path, text.count("\n")))
    for path, before, line in lines:
        with open(os.path.join(tree, path), encoding="utf-8") as file:
            text = file.read()
        at = text.index("\n", text.index(before)) + 1
        with open(os.path.join(tree, path), "w", encoding="utf-8") as file:
            file.write(text[:at] + line + "\n" + text[at:])
        stat.append((path, line.count("\n") + 1))
    return stat


def page_says(page, stat):
    with open(os.path.join(source, "docs", "reference", page), encoding="utf-8") as file:
        text = file.read()
    for path, n in stat:
        assert re.search(r"^ *%s \| +%d$" % (re.escape(path), n), text, re.M), f"{page} does not say: {path} | {n}"


def call(command, **more):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
    if done.returncode:
        wrong = [line for line in done.stdout.splitlines() if "error" in line.lower()] or done.stdout.splitlines()[-40:]
        sys.exit("\n".join([f"{' '.join(command)} ended with {done.returncode}:"] + wrong))
    return done.stdout


def rows(program, folder, name, scene, device):
    path, out = os.path.join(folder, name + ".yaml"), os.path.join(folder, name + "-" + device.replace(":", "-"))
    with open(path, "w", encoding="utf-8") as file:
        file.write(scene)
    shutil.rmtree(out, ignore_errors=True)
    call([program, "run", path, "-o", out, "--device", device])
    call([program, "export", out, "-f", "csv", "-o", out])
    with open(os.path.join(out, "histories.csv"), encoding="utf-8") as file:
        return [{key.split(" ")[0]: float(value) for key, value in row.items() if value} for row in csv.DictReader(file)]


def close(found, expected, relative):
    assert abs(found - expected) <= relative * abs(expected), (found, expected)


def main():
    folder = os.path.join(build, "adding")
    tree, made = os.path.join(folder, "tree"), os.path.join(folder, "build")
    copy(tree)
    page_says("adding_a_model.md", add(tree, MODEL))
    page_says("adding_an_effect.md", add(tree, EFFECT))
    cache = ["-DCMAKE_C_COMPILER_LAUNCHER=ccache", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    call(["cmake", "-S", tree, "-B", made, "-DCMAKE_BUILD_TYPE=Release", "-DBRC_TESTS=OFF", "-DBRC_ISA_LEVELS=v2", "-DBRC_LAST_PRECISION=0",
          "-DBRC_KERNEL_OPTIMISATION=-O1", "-DBRC_TARGET_WORKS=0"] + cache)
    call(["cmake", "--build", made, "--target", "breccia", "--parallel", "2"])
    program = os.path.join(made, "bin", "breccia")
    listed = call([program, "devices"])
    devices = ["cpu"] + (["opencl:0"] if re.search(r"opencl", listed) else [])
    for device in devices:
        # 48 springs along x of k = E S / L = 2.5e8 N/m, each longer by 25 um
        history = rows(program, folder, "spring", CUBE % ("spring", "{affine: {gradient: {x: [1e-4, 0, 0]}}}",
                                                          "duration: 2 ms, time_step: {auto: {safety: 0.05}}"), device)
        close(history[0]["elastic"], 48 * 0.5 * 2.5e8 * 25e-6**2, 1e-6)
        assert min(row["elastic"] for row in history) < 0.5 * history[0]["elastic"]  # it swings
        assert abs(history[-1]["closure"]) < 1e-3
        # v^2 / 2 a from 1 m/s at 10 m/s^2; all of the kinetic energy is lost
        history = rows(program, folder, "drag", CUBE % ("dlsm", "{velocity: {velocity: [1 m/s, 0, 0]}}",
                                                        "duration: 120 ms, constant_drag: 10 m/s^2"), device)
        close(history[-1]["path"], 0.05, 1e-3)
        close(history[-1]["damping"], 500, 1e-6)
        assert history[-1]["kinetic"] < 1e-12 and abs(history[-1]["closure"]) < 1e-9
        print(f"{device}: the springs hold what they should, the drag stops the cube where it should")


main()
