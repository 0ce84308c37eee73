#!/bin/sh
# quickstart refuses wrong arguments with exit code 2 before it touches anything, from any folder; and it builds no more kernels
# than a first run needs.
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
expect 2 "usage: quickstart run SCENE" mpi run missing.yaml
expect 2 "usage: quickstart run SCENE" mpi 0 run missing.yaml
expect 2 "usage: quickstart run SCENE" mpi 2 build
expect 2 "no scene file missing.yaml" mpi 2 run missing.yaml
expect 2 "no scene file missing.yaml" run missing.yaml
expect 0 "usage: quickstart run SCENE" --help
[ -z "$(ls -A "$folder")" ] || { echo "something was left in the folder it was called from"; failures=$((failures + 1)); }

# A clone whose tools only write down what they are asked for.
mkdir -p "$folder/clone" "$folder/tools" || exit 1
cp "$quickstart" "$folder/clone/quickstart"
echo "shape: box" >"$folder/clone/scene.yaml"
asked=$folder/asked
printf '#!/bin/sh\necho "install ok installed"\n' >"$folder/tools/dpkg-query"
printf '#!/bin/sh\necho "$(basename "$0") $*" >>"%s"\n' "$asked" >"$folder/tools/cmake"
cp "$folder/tools/cmake" "$folder/tools/ctest"
cp "$folder/tools/cmake" "$folder/tools/apt-get"
cp "$folder/tools/cmake" "$folder/tools/mpirun"
chmod +x "$folder/tools"/*
export PATH="$folder/tools:$PATH"

asks() { # asks YES NO ARGUMENTS...: what the tools are asked for has YES (words in this order) and not NO
    yes=$1 no=$2
    shift 2
    : >"$asked"
    "$folder/clone/quickstart" "$@" >"$folder/said" 2>&1 </dev/null
    all=$(tr '\n' ' ' <"$asked")
    case $all in
    *$no*) printf 'quickstart %s: asked for: %s\n' "$*" "$all"; failures=$((failures + 1)); return ;;
    esac
    # shellcheck disable=SC2254 # a pattern
    case $all in
    $yes) ;;
    *) printf 'quickstart %s: asked for: %s\n' "$*" "$all"; failures=$((failures + 1)) ;;
    esac
}

asks '*BRC_LAST_PRECISION=0*--target breccia *' brc_program run "$folder/clone/scene.yaml"
asks '*BRC_LAST_PRECISION=2*--target breccia *' brc_program run "$folder/clone/scene.yaml" --precision mixed
asks '*--target breccia brc_program *' "LAST_PRECISION=2" run "$folder/clone/scene.yaml" --device target
asks '*--preset mpi *--target breccia-mpi *mpirun *-n 3 *breccia-mpi run *scene.yaml *' 'preset release' mpi 3 run "$folder/clone/scene.yaml"
levels= best=
if [ "$(uname -m)" = x86_64 ] && grep -q '^flags.* avx2 ' /proc/cpuinfo; then
    levels='-DBRC_ISA_LEVELS=v2;v' best='-DBRC_ISA_LEVELS=v[34] '
fi
asks "*BRC_LAST_PRECISION=0 $best*--target breccia *" 'v2;' run "$folder/clone/scene.yaml"
asks "*BRC_LAST_PRECISION=0 $levels*--target breccia *" LAST_PRECISION=2 run "$folder/clone/scene.yaml" --exact
asks "*BRC_LAST_PRECISION=2 $levels*--target brc_program *" "LAST_PRECISION=0" build
asks '*-UBRC_ISA_LEVELS -UBRC_LAST_PRECISION*--target all *ctest*' "LAST_PRECISION=0" test
mkdir -p "$folder/clone/build/release" && : >"$folder/clone/build/release/CMakeCache.txt" # a folder that has its choice
asks '*--preset release *--target breccia *' LAST_PRECISION run "$folder/clone/scene.yaml"
asks '*BRC_LAST_PRECISION=2*' ISA_LEVELS run "$folder/clone/scene.yaml" --precision=single
echo 'BRC_ISA_LEVELS:STRING=v3' >"$folder/clone/build/release/CMakeCache.txt" # made for a first run
asks '*--preset release *--target breccia *' ISA_LEVELS run "$folder/clone/scene.yaml"
asks "*$levels*--target breccia *" LAST_PRECISION run "$folder/clone/scene.yaml" -x
asks "*BRC_LAST_PRECISION=2 $levels*--target brc_program *" LAST_PRECISION=0 build
exit "$failures"
