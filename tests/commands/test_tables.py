"""What is made from the tables of the commands: help, completion in bash, the manual page; and what a mistyped word is answered."""
import os
import re
import subprocess
import sys
import tempfile

PROGRAM = os.path.abspath(os.environ.get("BRC_PROGRAM", "build/bin/breccia"))


def run(*words, expect=0):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
    assert done.returncode == expect, f"{words}: exit code {done.returncode} instead of {expect}: {done.stderr}"
    return done.stdout if expect == 0 else done.stderr


listed = run("--help")
commands = re.findall(r"^  (\w+) ", listed, re.M)
assert len(commands) >= 12 and {"check", "run", "schema", "completion", "help"} <= set(commands), commands
assert listed == run("help") == run("-h")
assert run("-V") == run("--version") and run("-V").startswith("breccia ")
options = {}
for command in commands:
    text = run("help", command)
    assert text == run(command, "--help"), command
    options[command] = re.findall(r"^  (?:-\w, |    )--([\w-]+)", text, re.M)
    assert "help" in options[command], text
assert "did you mean 'export'?" in run("exprot", expect=2)
assert "did you mean 'check'?" in run("help", "chekc", expect=2)
assert "did you mean '--format'?" in run("export", "x", "--fromat", "vtu", expect=2)
assert "known are bash, zsh" in run("completion", "fish", expect=2)

manual = run("help", "--man")
assert manual.startswith(".TH BRECCIA 1 "), manual[:80]
plain = manual.replace("\\-", "-")
for command in commands:
    section = re.search(rf'^\.SS "breccia {command} .*?(?=^\.S[SH]|\Z)', plain, re.M | re.S)
    assert section, f"{command} is not in the manual page"
    for option in options[command]:
        assert option == "help" or f"--{option}\\fR" in section.group(0), f"{command} --{option} is not in the manual page"
for line in manual.splitlines():  # requests are those of man(7), and nothing else begins with a dot
    assert not line.startswith((".", "'")) or re.match(r"\.(TH|SH|SS|TP|PP|B|I)( |$)", line), line

script = run("completion", "bash")


def complete(*words):
    """What bash offers for the last word."""
    call = f'source {folder}/breccia; COMP_WORDS=({" ".join(repr(word) for word in words)}); COMP_CWORD={len(words) - 1}; _breccia; printf "%s\\n" "${{COMPREPLY[@]}}"'
    done = subprocess.run(["bash", "-c", call], capture_output=True, text=True, check=True, cwd=folder, env=dict(os.environ, PATH=f"{os.path.dirname(PROGRAM)}:{os.environ['PATH']}"))
    assert not done.stderr, done.stderr
    return set(done.stdout.split())


with tempfile.TemporaryDirectory() as folder:
    with open(f"{folder}/breccia", "w", encoding="utf-8") as file:
        file.write(script)
    open(f"{folder}/scene.yaml", "w", encoding="utf-8").close()
    os.mkdir(f"{folder}/results")
    assert complete("breccia", "") == set(commands) | {"--help", "--version"}
    assert complete("breccia", "ex") == {"export"}
    for command in commands:
        assert complete("breccia", command, "--") == {f"--{option}" for option in options[command]}, command
    assert complete("breccia", "export", "results", "--format", "vt") == {"vtu", "vtkhdf"}
    assert complete("breccia", "run", "-p", "") == {"double", "mixed", "single"}
    assert complete("breccia", "run", "sc") == {"scene.yaml"}
    assert complete("breccia", "report", "") == {"results"}
    assert complete("breccia", "run", "scene.yaml", "-o", "re") == {"results"}
    scenes = {line.split()[0] for line in run("new").split("\n\n")[0].splitlines()}
    assert "brazilian" in scenes and complete("breccia", "new", "") == scenes
    assert complete("breccia", "help", "sch") == {"schema"}
    assert complete("breccia", "completion", "z") == {"zsh"}
    assert "agh19-table3" in complete("breccia", "reproduce", "agh19-t")
assert run("completion", "zsh").startswith("#compdef breccia\n") and script in run("completion", "zsh")
print(f"{len(commands)} commands, {sum(map(len, options.values()))} options")
sys.exit(0)
