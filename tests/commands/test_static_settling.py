"""Static stages that begin out of balance: in gravity, after a dynamic stage, as loads are taken off. What they let go of is booked, so that the ledger
closes to what is of second order in strains of 1e-4 and in bending of the held end; and loads that are scaled to failure beside gravity."""
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from histories import PROGRAM, run  # noqa: E402 (beside this)

ROCK = "materials: {rock: {E: 50 GPa, nu: 0.25, density: 2650 kg/m^3, strength: {tension: 8 MPa}}}\n"
CELLS = "bodies: [{name: bar, material: rock, shape: {box: {size: [10 mm, 10 mm, 100 mm]}}, fill: {noisy_grid: {cells: [5, 5, 50], lloyd: 3}}}]\n"
BEAMS = "model: cbm\nbodies: [{name: bar, material: rock, shape: {box: {size: [10 mm, 10 mm, 50 mm]}}, fill: {packing: {elements: 500}}, beams: 8}]\n"
HELD = {CELLS: "face_displacement: {set: z+, x: 0, y: 0, z: 0}", BEAMS: "element_displacement: {set: z+, x: 0, y: 0, z: 0}"}
PULLED = {CELLS: "traction: {set: z-, z: -1 MPa", BEAMS: "element_force: {set: z-, z: -100 N"}


def stage(name, solver, *loads):
    return f"  - {{name: {name}, solver: {{{solver}}}, loads: [{', '.join('{' + load + '}' for load in loads)}]}}\n"


def ledger(folder, name):
    with open(os.path.join(folder, name, "summary.json"), encoding="utf-8") as file:
        return json.load(file)["ledger"]


def closes(folder, name, said, tolerance):
    got = ledger(folder, name)
    print(f"{name}: closure {got['closure']:.2e}, elastic {got['elastic_J']:.6g} J, released {got['damping_J']:.6g} J")
    assert abs(got["closure"]) < tolerance, got
    assert "ledger is off" not in said, said
    return got


def main():
    with tempfile.TemporaryDirectory() as folder:
        for body, name in ((CELLS, "cells"), (BEAMS, "beams")):
            held, pull = HELD[body], PULLED[body]
            # Hung at once: gravity does twice the elastic energy, and half of that is let go of.
            _, said = run(folder, f"{name}-hung", ROCK + body + "gravity: [0, 0, -10000 m/s^2]\nstages:\n" + stage("hang", "static: {}", held))
            got = closes(folder, f"{name}-hung", said, 1e-3)
            assert abs(got["damping_J"] / (got["elastic_J"] + got["stabilisation_J"]) - 1) < 1e-3, got
            assert abs(got["potential_J"] / got["damping_J"] + 2) < 2e-3, got
            # The load taken off: it takes back what it gave.
            _, said = run(folder, f"{name}-let-go", ROCK + body + "stages:\n" + stage("pull", "static: {}", held, pull + "}") + stage("free", "static: {}", held))
            got = closes(folder, f"{name}-let-go", said, 1e-3)
            peak = got["peak_elastic_J"]
            assert peak > 0 and abs(got["elastic_J"]) + abs(got["work_J"]) + abs(got["damping_J"]) < 1e-3 * peak, got
            # Ten times the load, or the end moved ten times as far, from one stage to the next: nothing is lost, and the next stage goes on.
            moved = held.replace("z+", "z-").replace("z: 0}", "z: %g um")
            for kind, loads in (("load", (pull + "}", pull.replace("z: -1", "z: -10") + "}")), ("end", (moved % -1 + "}", moved % -10 + "}"))):
                _, said = run(folder, f"{name}-more-{kind}", ROCK + body + "stages:\n" + stage("pull", "static: {}", held, loads[0])
                              + stage("more", "static: {}", held, loads[1]) + stage("rest", "dynamic: {steps: 20}", held, loads[1][:-1] + ", table: [[0 s, 1], [1 s, 1]]}"))
                got = closes(folder, f"{name}-more-{kind}", said, 1e-3)
                held_now = got["elastic_J"] + got["stabilisation_J"] + got["kinetic_J"]
                assert got["damping_J"] == 0 and abs(got["initial_J"]) < 1e-3 * held_now and abs(got["work_J"] / held_now - 1) < 1e-3, got
            # Torn by events whose first equilibrium is ten times the end's last place, unloaded, loaded again: what is moved begins where it stands, nothing is ever
            # strained by more than the loads ask for, and what is left of the work after unloading is what was lost. Both are of second order in strains of 1e-4.
            held_bar = [(moved % way + "}",) for way in (-1, -10, 0, -1)]
            _, said = run(folder, f"{name}-unloaded", ROCK + body + "fracture: {}\nstages:\n" + stage("pull", "static: {}", held, *held_bar[0])
                          + stage("tear", "static: {events: 10}", held, *held_bar[1]) + stage("unload", "static: {}", held, *held_bar[2]))
            got = closes(folder, f"{name}-unloaded", said, 1e-3)
            most = got["peak_elastic_J"]
            assert most < 2.6 * held_now, (got, held_now)  # 8 MPa are a strain of 1.6e-4, held_now is of 1e-4
            assert got["elastic_J"] < 1e-9 * most and abs(got["work_J"] - got["damping_J"] - got["fracture_J"]) < 1e-3 * most, got
            _, said = run(folder, f"{name}-again", ROCK + body + "stages:\n" + stage("pull", "static: {}", held, *held_bar[0]) + (stage("modes", "modes: {count: 3}", held) if body == CELLS else "")
                          + stage("again", "static: {increments: 2}", held, *held_bar[3]))
            got = closes(folder, f"{name}-again", said, 1e-4)
            # For the modes the end's faces are free: the cells behind them, 2 % of the bar, read otherwise.
            assert abs(got["peak_elastic_J"] / got["elastic_J"] - 1) < 1e-3 and got["initial_J"] == 0, got
            # Swinging, then led to ten times the load: damping takes and gives nothing back.
            _, said = run(folder, f"{name}-swung-more", ROCK + body + "stages:\n" + stage("swing", "dynamic: {duration: 30 us}", held, pull + "}")
                          + stage("more", "static: {}", held, pull.replace("z: -1", "z: -10") + "}") + stage("rest", "dynamic: {steps: 20}", held, pull.replace("z: -1", "z: -10") + ", table: [[0 s, 1], [1 s, 1]]}"))
            got = closes(folder, f"{name}-swung-more", said, 1e-3)
            assert got["damping_J"] >= 0, got
            # Swinging, then held still: what swung is gone, of spheres that turn too; and nothing moves as the next stage begins.
            still = pull + ", table: [[0, 1], [1, 1]]}"
            _, said = run(folder, f"{name}-swung", ROCK + body + "stages:\n" + stage("swing", "dynamic: {duration: 30 us}", held, pull + "}")
                          + stage("hold", "static: {}", held, still) + stage("rest", "dynamic: {duration: 20 us}", held, pull + "}"))
            got = closes(folder, f"{name}-swung", said, 2e-3)
            assert got["kinetic_J"] < 1e-6 * got["elastic_J"], got
            # The same into a stage of events.
            _, said = run(folder, f"{name}-torn", ROCK + body + "fracture: {}\nstages:\n" + stage("swing", "dynamic: {duration: 30 us}", held, pull + "}")
                          + stage("tear", "static: {events: 3}", held, pull + "}"))
            closes(folder, f"{name}-torn", said, 1e-3)
        # 10 cm of 2650 kg/m^3 at 20 000 m/s^2 pull the uppermost cells, whose middles are 1 mm down, by 5.25 MPa; 2.75 of 8 MPa are left to
        # the end, less what uneven cells make of it, some 2 %.
        hung = ROCK + CELLS + "fracture: {}\ngravity: [0, 0, -%d m/s^2]\nstages:\n"
        up = "face_displacement: {set: z+, z: 0}"
        _, said = run(folder, "scaled", hung % 20000 + stage("pull", "static: {to_failure: 100 %}", up, PULLED[CELLS] + "}"))
        scaled = float(said.split("the load is scaled to ")[1].split(",")[0])
        print(f"scaled: {scaled} MPa")
        assert abs(scaled / 2.753 - 1) < 0.05, said
        assert "where the worst element is at 1 of its limit" in said, said
        path = os.path.join(folder, "heavy.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write("version: 1\noutput: {frames: none, picture: false}\n" + hung % 40000 + stage("hang", "static: {to_failure: 100 %}", up))
        done = subprocess.run([PROGRAM, "run", path, "-o", os.path.join(folder, "heavy"), "--device", "cpu"], capture_output=True, text=True, check=False)
        assert done.returncode == 2 and "to_failure scales the loads of the stage and not gravity" in done.stderr, done.stderr


main()
