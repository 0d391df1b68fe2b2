#!/usr/bin/env bash
# Prints a folder with the headers of CPython 3.13, with which the wheel for Python 3.12 and later is made where this machine's
# own Python is older (tools/build_more_wheels.sh). They are those of Debian 13's package, unpacked in build/python; nothing
# is installed, and no root is needed. A second start needs no network. `tools/python_headers.sh arm64`: another processor's,
# whose packages dpkg must know.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
architecture=${1:-$(dpkg --print-architecture)}
release=trixie package=libpython3.13-dev:$architecture
folder=$PWD/build/python/headers/$architecture
if [[ ! -f $folder/usr/include/python3.13/Python.h ]]; then
    apt=build/python/apt
    rm -rf "$apt" "$folder"
    mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial"
    key=/usr/share/keyrings/debian-archive-keyring.gpg
    archive=$(tools/debian_archives.sh "$release" | head -1)
    printf 'deb [signed-by=%s] %s main\n' "$key" "$archive" >"$apt/sources.list"
    settings=(-q -o "Dir::Etc::SourceList=$PWD/$apt/sources.list" -o Dir::Etc::SourceParts=/dev/null
        -o "Dir::State::Lists=$PWD/$apt/lists" -o "Dir::Cache=$PWD/$apt/cache" -o APT::Sandbox::User=)
    log=$apt/log
    if ! (apt-get "${settings[@]}" update && cd "$apt" && apt-get "${settings[@]}" download "$package") >"$log" 2>&1; then
        tail -5 "$log" >&2
        printf 'python_headers: %s of Debian 13 could not be fetched (apt says why above)\n' "$package" >&2
        printf '  remedy: no network? Or start tools/build_wheel.sh with PYTHON=... of 3.12 or later, which has its headers\n' >&2
        exit 1
    fi
    mkdir -p "$folder"
    dpkg-deb -x "$apt/${package%:*}"_*.deb "$folder"
    rm -rf "$apt"
fi
printf '%s\n' "$folder/usr/include/python3.13"
