#!/bin/sh
# quickstart refuses wrong arguments with exit code 2 before it touches anything, from any folder; it builds the kernels of
# this processor at first, and all for the tests.
set -u
quickstart=${BRC_SOURCE_DIR:-$(cd "$(dirname "$0")/../.." && pwd)}/quickstart
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0

expect() { # expect CODE TEXT ARGUMENTS...: exit code and a piece of what is said
    code=$1 text=$2
    shift 2
    said=$("$quickstart" "$@" 2>&1 </dev/null)
    got=$?
    case $said in
    *"$text"*) [ "$got" = "$code" ] && return ;;
    esac
    printf 'quickstart %s: exit code %s (expected %s), said: %s\n' "$*" "$got" "$code" "$said"
    failures=$((failures + 1))
}

expect 2 "usage: quickstart run SCENE"
expect 2 "usage: quickstart run SCENE" fly
expect 2 "usage: quickstart run SCENE" run
expect 2 "usage: quickstart run SCENE" run -o somewhere
expect 2 "usage: quickstart run SCENE" build something
expect 2 "usage: quickstart run SCENE" docs something
expect 2 "no scene file missing.yaml" run missing.yaml
expect 0 "usage: quickstart run SCENE" --help
[ -z "$(ls -A "$folder")" ] || { echo "something was left in the folder it was called from"; failures=$((failures + 1)); }

# A copy with tools that only note what they are asked for.
mkdir -p "$folder/copy/build/release" "$folder/tools"
cp "$quickstart" "$folder/copy/quickstart"
printf '#!/bin/sh\nprintf "%%s\\n" "$*" >>"%s/asked"\n' "$folder" >"$folder/tools/cmake"
cp "$folder/tools/cmake" "$folder/tools/ctest"
printf '#!/bin/sh\nprintf "install ok installed"\n' >"$folder/tools/dpkg-query"
chmod +x "$folder/tools/"*
levels=
if [ "$(uname -m)" = x86_64 ] && grep -q '^flags.* avx2 ' /proc/cpuinfo; then
    levels=' -DBRC_ISA_LEVELS=v2;v'
fi
configured() { # configured COMMAND TEXT: what CMake is given first begins so
    : >"$folder/asked"
    PATH=$folder/tools:$PATH "$folder/copy/quickstart" "$1" >/dev/null 2>&1
    first=$(head -n 1 "$folder/asked")
    case $first in
    "$2"*) return ;;
    esac
    printf 'quickstart %s configures with "%s", not "%s..."\n' "$1" "$first" "$2"
    failures=$((failures + 1))
}
configured build "--preset release$levels"
configured test "--preset release -UBRC_ISA_LEVELS"
: >"$folder/copy/build/release/CMakeCache.txt"
configured build "--preset release"
[ "$first" = "--preset release" ] || { echo "quickstart build changes a folder that has its levels: $first"; failures=$((failures + 1)); }
exit "$failures"
