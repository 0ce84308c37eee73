"""bench/gpu-day rehearsed: the bundle is made, unpacked in an empty root that holds a shell, some tools and, in the place of a
vendor's driver, PoCL's library, and run there by its one command in the layout of a GPU."""
import csv
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE, BUILD = os.environ["BRC_SOURCE_DIR"], os.environ["BRC_BUILD_DIR"]
MOST_MB = 60
TOOLS = ["sh", "basename", "cat", "cp", "cut", "date", "dirname", "ls", "mkdir", "mktemp", "rm", "sed", "sha256sum", "timeout", "tr", "uname"]
DRIVER_TOOLS = ["ld"]  # PoCL links what it compiles


def skip(why, excused=False):
    """excused: what no package brings is a skip even where BRC_NO_SKIPS is set (tests/skip.h)."""
    refused = bool(os.environ.get("BRC_NO_SKIPS")) and not excused
    print(f"SKIPPED{', but BRC_NO_SKIPS is set' if refused else ''}: {why}")
    sys.exit(1 if refused else 77)


def libraries_of(path):
    text = subprocess.run(["ldd", path], capture_output=True, text=True, check=True).stdout
    return re.findall(r"(/\S+)", text)


def copy(path, root):
    """A file with the libraries it needs, at the same places."""
    for one in [path] + libraries_of(path):
        place = root + one
        if not os.path.exists(place):
            os.makedirs(os.path.dirname(place), exist_ok=True)
            shutil.copy(one, place)


def copy_folder(path, root):
    """What can be read of a folder (some files of /sys cannot)."""
    def one(source, target):
        try:
            shutil.copyfile(source, target)
        except OSError:
            pass
    if os.path.isdir(path):
        shutil.copytree(path, root + path, copy_function=one, symlinks=True, dirs_exist_ok=True, ignore_dangling_symlinks=True)


def make_root(root, driver):
    for link in ("bin", "lib", "lib64"):  # as Debian has them
        if os.path.islink(f"/{link}"):
            os.makedirs(f"{root}/{os.readlink(f'/{link}')}")
            os.symlink(os.readlink(f"/{link}"), f"{root}/{link}")
    for folder in ("tmp", "proc", "dev"):
        os.makedirs(f"{root}/{folder}")
    for tool in TOOLS + DRIVER_TOOLS:
        copy(shutil.which(tool, path="/usr/bin:/bin"), root)
    copy(driver, root)
    for folder in ("/usr/share/pocl", "/sys/devices/system/cpu", "/sys/devices/system/node"):
        copy_folder(folder, root)
    lib = f"{root}/usr/lib/x86_64-linux-gnu"  # PoCL names them to the linker as a compiler does; its kernels need none of them
    for name, found in (("libm.so", "libm.so.6"), ("libc.so", "libc.so.6"), ("libgcc_s.so", "libgcc_s.so.1")):
        copy(f"/lib/x86_64-linux-gnu/{found}", root)
        os.symlink(found, f"{lib}/{name}")
    with open(f"{lib}/libgcc.a", "w", encoding="utf-8") as file:
        file.write("!<arch>\n")
    for plugin in glob.glob(os.path.dirname(driver) + "/pocl/*.so"):
        copy(plugin, root)
    open(f"{root}/dev/null", "w", encoding="utf-8").close()
    for path in ("/proc/cpuinfo", "/proc/meminfo"):
        with open(path, encoding="utf-8") as source, open(root + path, "w", encoding="utf-8") as target:
            target.write(source.read())


def rows_of(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def main():
    if os.geteuid() != 0:
        skip("only root can enter an empty root", excused=True)
    with open(f"{BUILD}/CMakeCache.txt", encoding="utf-8") as file:
        if "BRC_SANITIZE:BOOL=ON" in file.read():
            skip("the sanitizers' libraries are not those of a bundle", excused=True)
    drivers = glob.glob("/usr/lib/x86_64-linux-gnu/libpocl.so.2*")
    if not drivers:
        skip("no libpocl.so.2 to play the vendor's driver (Debian: pocl-opencl-icd)")
    driver = sorted(drivers)[0]
    with tempfile.TemporaryDirectory(prefix="gpu-day-") as folder:
        packed, root = f"{folder}/day.tar.gz", f"{folder}/root"
        subprocess.run([f"{SOURCE}/bench/gpu-day", "bundle", "--build", BUILD, "-o", packed], check=True)
        size = os.path.getsize(packed) / 1e6
        assert size <= MOST_MB, f"the bundle takes {size:.0f} MB, at most {MOST_MB}"
        os.makedirs(root)
        subprocess.run(["tar", "-C", root, "-xzf", packed], check=True)
        make_root(root, driver)
        command = [shutil.which("chroot", path="/usr/sbin:/sbin:/usr/bin"), root, "/breccia-gpu-day/bench/gpu-day", "run", "--short", "--minutes", "5"]
        clean = {"PATH": "/usr/bin:/bin", "HOME": "/tmp", "POCL_CACHE_DIR": "/tmp/pocl", "BRECCIA_OPENCL_LAYOUT": "gpu", "OMP_WAIT_POLICY": "passive"}
        wrong = subprocess.run(command[:-3] + ["--parts", "bits,nothing"], env=clean, capture_output=True, text=True)
        assert wrong.returncode == 2 and "--parts nothing: expected some of 1e6,bar" in wrong.stderr, wrong
        without = subprocess.run(command, env=clean, capture_output=True, text=True)
        assert without.returncode == 3 and "--driver LIBRARY names one" in without.stderr, f"without a driver: {without}"
        done = subprocess.run(command + ["--driver", driver], env=clean, capture_output=True, text=True)
        assert done.returncode == 3 and "no GPU among the devices" in done.stderr, f"PoCL is no GPU: {done}"
        done = subprocess.run(command + ["--driver", driver, "--device", "opencl:0"], env=clean, capture_output=True, text=True)
        print(done.stdout, done.stderr)
        results = glob.glob(f"{root}/breccia-gpu-day/bench/results/20*")
        texts = "".join(open(path, encoding="utf-8").read() for path in glob.glob(f"{results[0]}/*.txt")) if results else ""
        assert done.returncode == 0 and len(results) == 1, f"exit code {done.returncode}, results {results}\n{texts}"
        assert "opencl:0" in open(f"{results[0]}/machine.txt", encoding="utf-8").read()
        parts = rows_of(f"{results[0]}/parts.csv")
        assert len(parts) == 3 and all(row["status"] == "done" for row in parts), parts
        done = subprocess.run(command[:-3] + ["--driver", driver, "--device", "opencl:0", "--parts", "suites"], env=clean, capture_output=True, text=True)
        assert done.returncode == 0 and "made without --tests" in done.stdout, done
        bits = rows_of(f"{results[0]}/bits.csv")
        assert [(row["equal_frames"], row["frames"]) for row in bits] == [("7", "7")], bits
        throughput = rows_of(f"{results[0]}/throughput-1e3.csv")
        assert len(throughput) == 1 and throughput[0]["lanes"] == "1" and float(throughput[0]["bond_updates_per_s"]) > 0, throughput
        profile = rows_of(f"{results[0]}/profile-elastic.csv")
        assert {"dlsm_gradient", "dlsm_stress", "dlsm_flux_pass", "dlsm_force", "advance"} <= {row["kernel"] for row in profile}, profile
        assert sum(float(row["seconds"]) for row in profile) > 0, profile


if __name__ == "__main__":
    main()
