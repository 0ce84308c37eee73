#!/bin/sh
# Two minutes of libFuzzer on the scene reader, with AddressSanitizer and UndefinedBehaviorSanitizer: no crash, leak or time-out.
# The hour is a documented command (tests/fuzz/README.md). Skipped (77), visibly, where clang or its fuzzer runtime is missing.
set -eu
source=${BRC_SOURCE_DIR:?}
seconds=${BRC_FUZZ_SECONDS:-120}
skip() { # visibly; where nothing may be skipped (tests/skip.h), a failure
    echo "SKIPPED: $1"
    [ -z "${BRC_NO_SKIPS:-}" ] || exit 1
    exit 77
}
clang=$(command -v clang-14 || command -v clang) || skip "no clang"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
printf 'int LLVMFuzzerTestOneInput(const unsigned char *d, unsigned long n) { return d && n > 1e9; }\n' > "$folder/probe.c"
"$clang" -fsanitize=fuzzer,address "$folder/probe.c" -o "$folder/probe" 2>/dev/null ||
    skip "$clang has no libFuzzer runtime (Debian: libclang-rt-14-dev)"
# shapes and limits of quality come from the build's library; the version is generated, and the reader does not ask for it; ranks_mpi*.c are ranks_one.c of breccia-mpi
base=$(ls "$source"/host/base/*.c | grep -v -e /version.c -e /ranks_mpi)
"$clang" -std=gnu11 -D_GNU_SOURCE -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined \
    "$source"/tests/fuzz/fuzz_scene.c "$source"/host/scene/*.c "$source"/host/scene/models/*.c $base "${BRC_BUILD_DIR:?}"/libbrc_preprocess.a -o "$folder/fuzz_scene" -lyaml -lm "$(gcc -print-file-name=libgomp.so)"
mkdir "$folder/corpus"
for scene in "$source"/examples/*/scene.yaml; do
    cp "$scene" "$folder/corpus/$(basename "$(dirname "$scene")").yaml"
done
cd "$folder"
./fuzz_scene -dict="$source/tests/fuzz/scene.dict" -max_len=4096 -timeout=20 -max_total_time="$seconds" -seed=1 corpus > log 2>&1 || {
    tail -40 log
    exit 1
}
tail -2 log
