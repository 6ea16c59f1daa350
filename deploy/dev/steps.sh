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
    local line count=0
    while IFS= read -r line || [ -n "$line" ]; do
        if [ -t 1 ]; then
            printf '\r\033[K    %.90s' "$line"
        elif [[ $line =~ ^\[[0-9]+/[0-9]+\] ]]; then
            if [ $((count++ % 10)) -eq 0 ]; then printf '    %s\n' "$line"; fi
        elif [ ${#line} -lt 200 ]; then
            printf '    %s\n' "$line"
        fi
    done
    if [ -t 1 ]; then printf '\r\033[K'; fi
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
