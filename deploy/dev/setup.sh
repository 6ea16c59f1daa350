#!/usr/bin/env bash
# Installs what building and running Volcast needs on Debian 12; with --test also what testing it
# needs, with --dev that and the compiler of sanitizers and fuzzing. Does nothing, without a network,
# where everything is there already.
set -euo pipefail

usage="usage: deploy/dev/setup.sh [--test|--dev]"
case "${1:-}" in
    --help | -h) echo "$usage"; exit 0 ;;
    "" | --test | --dev) ;;
    *) echo "there is no option '$1'; $usage" >&2; exit 2 ;;
esac

packages=(
    # tools
    build-essential cmake ninja-build pkg-config ccache mold ca-certificates protobuf-compiler
    # libraries
    libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri libgl-dev libepoxy-dev libglm-dev
    libopenimageio-dev libtet1.5-dev libboost1.81-dev libprotobuf-dev libturbojpeg0-dev
    libdeflate-dev libcli11-dev libspdlog-dev libseccomp-dev libssl-dev
    libavcodec-dev libavutil-dev libwebp-dev libxxhash-dev prometheus-cpp-dev
    glslang-dev glslang-tools  # The CMake package of the first looks for programs of the second.
    # read by volcast-import
    python3-vtk9 python3-meshio python3-h5py python3-numpy
    # the build, googletest and benchmark included: one configuration for users and tests
    libgtest-dev libgmock-dev libbenchmark-dev libpng-dev
)
if [ -n "${1:-}" ]; then
    packages+=(chromium clang-format-14 python3-websockets)
fi
if [ "${1:-}" = --dev ]; then
    packages+=(clang-14 libclang-rt-14-dev clang-tidy-14)
fi
# Any Node.js from 18 on will do; Debian 12's own is 18.
node_major=$(node --version 2>/dev/null | sed 's/^v\([0-9]*\).*/\1/' || true)
if [ "${node_major:-0}" -lt 18 ]; then packages+=(nodejs); fi
if ! command -v npm >/dev/null; then packages+=(npm); fi

missing=()
for package in "${packages[@]}"; do
    state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$state" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
    echo "all ${#packages[@]} packages are installed"
    exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "needs root or sudo to install: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
fi
echo "installing ${#missing[@]} packages: ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "${missing[@]}"
