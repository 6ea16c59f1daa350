#!/usr/bin/env bash
# Checks the sources. --sources: format and includes, in seconds. --tidy: clang-tidy over
# all C++ of build/dev or build/ci as well, in many minutes. Says what failed; exit 1 if any did.
set -uo pipefail
cd "$(dirname "$0")/../.."
status=0

check() {  # TITLE COMMAND...
    local title=$1
    shift
    if "$@"; then echo "ok: $title"; else
        echo "FAILED: $title"
        status=1
    fi
}

format() {
    git ls-files -z '*.cpp' '*.h' | xargs -0 clang-format-14 --dry-run --Werror
}

tidy() {
    local build=build/dev
    [ -f $build/compile_commands.json ] || build=build/ci
    git ls-files -z '*.cpp' | grep -zv '^tests/' |
        xargs -0 -n 4 -P "$(nproc)" clang-tidy-14 -p $build --quiet
}

check "format (clang-format 14)" format
check "includes follow the layers" python3 deploy/dev/check_includes.py
if [ "${1:-}" = --tidy ]; then check "clang-tidy" tidy; fi
exit $status
