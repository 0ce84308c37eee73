#!/bin/sh
# quickstart refuses wrong arguments with exit code 2 before it touches anything, from any folder.
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
exit "$failures"
