# Shell functions that deploy/run and deploy/test share; sourced, not run.
# A step prints its title, keeps its output in build/log/, and on failure says what failed and why.

repo=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
logs=$repo/build/log
mkdir -p "$logs"
export CCACHE_BASEDIR=$repo
jobs=${VOLCAST_JOBS:-$(nproc)}

bold() { if [ -t 1 ]; then printf '\033[1m%s\033[0m\n' "$1"; else printf '%s\n' "$1"; fi; }

# step TITLE LOGNAME COMMAND...: shows the command's progress lines and keeps all of its output.
step() {
    local title=$1 log=$logs/$2.log started=$SECONDS status
    shift 2
    bold "==> $title"
    set +e
    "$@" 2>&1 | tee "$log" | progress
    status=${PIPESTATUS[0]}
    set -e
    if [ "$status" -ne 0 ]; then
        bold "==> FAILED: $title (exit $status). The end of ${log#"$repo"/}:"
        tail -n 40 "$log"
        return "$status"
    fi
    printf '    done in %d s\n' $((SECONDS - started))
}

# Passes on what a person wants to see: on a terminal one moving line, else every tenth line of a
# compiler's counter and everything else that is short.
progress() {
    if [ -t 1 ]; then
        awk '{ printf "\r\033[K    %.90s", $0; fflush() } END { printf "\r\033[K" }'
    else
        awk '/^\[[0-9]+\/[0-9]+\]/ { if (++n % 10 == 1) { print "    " $0; fflush() } next }
             { if (length($0) < 200) { print "    " $0; fflush() } }'
    fi
}

install_packages() { "$repo/deploy/dev/setup.sh" "$@"; }

build_server() {  # PRESET [TARGET...]
    local preset=$1
    shift
    cmake --preset "$preset" -S "$repo" && cmake --build "$repo/build/$preset" -j "$jobs" \
        ${1:+--target "$@"}
}

# npm ci only where the lock file is newer than what is installed.
install_client() {
    local stamp=$repo/web_client/node_modules/.installed
    [ "$stamp" -nt "$repo/web_client/package-lock.json" ] && return 0
    npm ci --prefix "$repo/web_client" --no-audit --no-fund && touch "$stamp"
}

build_client() { npm run --prefix "$repo/web_client" build; }
