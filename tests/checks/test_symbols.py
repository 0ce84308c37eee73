"""Symbols of the folders' libraries start with brc_, those of the public header with breccia_, and libbreccia.so shows only these; no library ends the program."""
import glob
import os
import re
import subprocess
import sys
import repository

BUILD = os.environ["BRC_BUILD_DIR"]
ENDS_THE_PROGRAM = {"exit", "_exit", "_Exit", "quick_exit", "abort"}
ENDS_ITS_CHILD = {("opencl_aside.c.o", "_exit"), ("study_runs.c.o", "_exit")}  # (object, function): a process that it has made itself


def exported(listing):
    """listing: what nm -A -g prints. Weak symbols (C++ templates, dispatchers of the compiler) are not ours to name."""
    findings = []
    for library, text in listing.items():
        for line in text.splitlines():
            match = re.search(r"([^:]*):[0-9a-f]* *([A-Za-z]) (\S+)$", line)
            if not match:
                continue
            member, kind, name = match.groups()
            if kind in "TDBRCSGi" and not name.startswith(
                    ("brc_", "breccia_", ".gomp_critical_user_brc_", "__odr_asan", "__asan", "__start_", "__stop_")):
                findings.append(f"{library}: exports {name}; public names start with brc_, others are static")
            if kind == "U" and name in ENDS_THE_PROGRAM and (member, name) not in ENDS_ITS_CHILD:
                findings.append(f"{library}: calls {name}; only the main program ends the program")
    return findings


def shown(listing):
    """listing: what nm -D --defined-only prints of the shared library: the public functions and the name of their version."""
    return [f"{library}: shows {line.split()[-1]}" for library, text in listing.items() for line in text.splitlines()
            if not re.fullmatch(r"breccia_\w+(@@BRECCIA_\d+)?|BRECCIA_\d+", line.split()[-1])]


listing = {}
for path in sorted(glob.glob(os.path.join(BUILD, "libbr*.a"))):
    listing[os.path.basename(path)] = subprocess.run(["nm", "-A", "-g", path], capture_output=True, text=True,
                                                     check=True).stdout
if not listing:
    sys.exit("symbols: no library is built")
bad = {"foreign name": {"a": "liba.a:b.o:0000000000000010 T solve\n"}, "foreign data": {"a": "liba.a:b.o:00 B table\n"},
       "end": {"a": "liba.a:b.o:                 U exit\n"}}
shared = {}
for path in glob.glob(os.path.join(BUILD, "lib", "libbreccia.so")):
    shared[os.path.basename(path)] = subprocess.run(["nm", "-D", "--defined-only", path], capture_output=True, text=True,
                                                    check=True).stdout
repository.finish([repository.report("symbols", exported, listing, bad),
                   repository.report("shown", shown, shared, {"inside": {"a": "0000000000001234 T brc_scene_read\n"}})])
