"""The rules of the build: the commit that a binary names, and that quickstart installs what CMake asks for."""
import os
import re
import subprocess
import sys
import tempfile
import repository

FAILURES = []


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def commit_of(source, folder):
    """What cmake/version.cmake writes for this source folder."""
    header = os.path.join(folder, "version_generated.h")
    subprocess.run(["cmake", f"-DSOURCE={source}", "-DVERSION=1.2.3", f"-DHEADER={header}", "-P",
                    os.path.join(repository.ROOT, "cmake/version.cmake")], check=True, capture_output=True)
    with open(header, encoding="utf-8") as file:
        text = file.read()
    expect('#define BRC_GENERATED_VERSION "1.2.3"' in text, "the header lacks the version: " + text)
    return re.search(r'BRC_GENERATED_COMMIT "(.*)"', text).group(1)


def git(folder, *arguments):
    identity = ["-c", "user.name=test", "-c", "user.email=test@example.org"]
    return subprocess.run(["git", "-C", folder, *identity, *arguments], check=True, capture_output=True,
                          text=True).stdout.strip()


with tempfile.TemporaryDirectory() as folder:
    source = os.path.join(folder, "source")
    inner = os.path.join(source, "unpacked")
    os.makedirs(inner)
    expect(commit_of(source, folder) == "unknown", "outside git the commit is not 'unknown'")
    git(source, "init", "-q")
    expect(commit_of(source, folder) == "unknown", "before the first commit the commit is not 'unknown'")
    with open(os.path.join(source, "file"), "w", encoding="utf-8") as file:
        file.write("one\n")
    git(source, "add", "file")
    git(source, "commit", "-q", "-m", "first")
    head = git(source, "rev-parse", "HEAD")
    expect(commit_of(source, folder) == head, "the commit is not the one of HEAD")
    expect(commit_of(inner, folder) == "unknown", "a folder inside somebody else's repository takes its commit")
    with open(os.path.join(source, "file"), "w", encoding="utf-8") as file:
        file.write("two\n")
    expect(commit_of(source, folder) == head + "-changed", "changed files are not told")

texts = repository.read(r"^(quickstart|cmake/dependencies\.cmake)$")
installed = " ".join(re.findall(r'^(?:\w+_)?packages="([^"]*)"', texts["quickstart"], re.M)).split()
asked = set(re.findall(r"\b((?:lib[\w.+-]*|voro\+\+|opencl|ocl-icd-opencl)-(?:dev|headers))\b",
                       texts["cmake/dependencies.cmake"]))
expect(len(asked) >= 10, f"only {len(asked)} packages are found in cmake/dependencies.cmake")
for package in sorted(asked - set(installed)):
    expect(False, f"cmake/dependencies.cmake asks for {package}, which quickstart does not install")

for failure in FAILURES:
    print("build: " + failure)
sys.exit(1 if FAILURES else 0)
