"""Kernels are launched by the names of their parameters (host/solver/core/passes.h); by position in host/solver/utilities/ alone."""
import re
import repository

ALLOWED = ("host/solver/utilities/", "host/device/", "host/solver/core/passes.c")
POSITIONAL = re.compile(r"\b(BRC_LAUNCH|brc_kernel_launch)\b")


def launches(files):
    return [f"{path}:{number}: launches by position; make a pass (host/solver/core/passes.h)" for path, text in files.items()
            if not path.startswith(ALLOWED)
            for number, line in enumerate(repository.code_of(text).split("\n"), 1) if POSITIONAL.search(line)]


# bench/launches.c measures what a launch by itself takes
files = {path: text for path, text in repository.read(r"^(host|bench)/.*\.(c|h)$").items() if path != "bench/launches.c"}
repository.finish([repository.report("launches", launches, files,
                                     {"one": {"host/solver/run/a.c": "BRC_TRY(BRC_LAUNCH(k, 1, BRC_INT(1)));\n"}})])
