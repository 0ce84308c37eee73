"""Programs under mpirun, for the tests of this folder."""
import os
import re
import shutil
import subprocess
import sys
import time

BUILD = os.environ["BRC_BUILD_DIR"]
LAUNCH = ["mpirun", "--allow-run-as-root", "--quiet", "--oversubscribe", "--bind-to", "none"]


def need(program):
    """The path of a program of the build; without it the test is skipped, which is a failure where nothing may be."""
    path = os.path.join(BUILD, program)
    if not shutil.which("mpirun") or not os.path.exists(path):
        print(f"{program} or mpirun is missing: Debian packages libopenmpi-dev, openmpi-bin")
        sys.exit(1 if os.environ.get("BRC_NO_SKIPS") else 77)
    return path


def start(n, command, delay_us=0, **more):
    """Popen of a command on n ranks; more: variables of the environment."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", BRECCIA_RANKS_DELAY_US=str(delay_us), **more)
    return subprocess.Popen(LAUNCH + ["-n", str(n)] + command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, env=environment)


def below(process):
    """The process and all that it started."""
    found, children = [], {}
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/stat", encoding="ascii", errors="replace") as file:
                children.setdefault(int(file.read().rsplit(")", 1)[1].split()[1]), []).append(int(name))
        except OSError:
            pass
    todo = [process]
    while todo:
        found.append(todo.pop())
        todo += children.get(found[-1], [])
    return found


def pages(process):
    """Bytes of the process by the names of smaps_rollup; none once it has ended."""
    try:
        with open(f"/proc/{process}/smaps_rollup", encoding="ascii") as file:
            return {name: 1024 * int(size) for name, size in re.findall(r"^(\w+): +(\d+) kB", file.read(), re.M)}
    except OSError:
        return {}


def watch_each(process, name):
    """Until a Popen ends: the most bytes of each of its processes, most first."""
    most = {}
    while process.poll() is None:
        for number in below(process.pid):
            most[number] = max(most.get(number, 0), pages(number).get(name, 0))
        time.sleep(0.02)
    return sorted(most.values(), reverse=True)


def watch(process, names):
    """Until a Popen ends: the most bytes that one of its processes has, by name."""
    most = dict.fromkeys(names, 0)
    while process.poll() is None:
        for one in map(pages, below(process.pid)):
            most = {name: max(bytes_, one.get(name, 0)) for name, bytes_ in most.items()}
        time.sleep(0.02)
    return most


def held(process):
    """Until a Popen ends: the most bytes that are its own. Looked at every half millisecond (statm is cheap), for a peak may be as short
    as some milliseconds."""
    most, page = 0, os.sysconf("SC_PAGE_SIZE")
    while process.poll() is None:
        try:
            with open(f"/proc/{process.pid}/statm", encoding="ascii") as file:
                resident, shared = file.read().split()[1:3]
            most = max(most, page * (int(resident) - int(shared)))
        except (OSError, ValueError):
            pass
        time.sleep(0.0005)
    return most
