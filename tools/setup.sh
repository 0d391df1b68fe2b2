#!/usr/bin/env bash
# Installs what the build needs: `tools/setup.sh build test`. The groups stand in tools/packages.txt. A package that is
# already there costs nothing, so a second start needs neither root nor a network. Set ROBOSS_SKIP_SETUP=1 on a system
# without apt, after installing the counterparts of that list.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

fail() {
    printf 'setup: %s\n' "$*" >&2
    exit 1
}

# The codename of this system's release, such as bookworm.
release() {
    (. "${ROBOSS_OS_RELEASE:-/etc/os-release}" 2>/dev/null && printf '%s' "${VERSION_CODENAME:-}") || true
}

# Prints the packages of the groups given, in the order of the list, but for those that a command makes unneeded and
# those of another release.
wanted_packages() {
    local group package mark release
    release=$(release)
    while read -r group package mark _; do
        [[ $mark == unless=* ]] && command -v "${mark#unless=}" >/dev/null && continue
        [[ $mark == only=* && ${mark#only=} != "$release" ]] && continue
        [[ " $* " == *" $group "* ]] && printf '%s\n' "$package"
    done < <(grep -v '^#' "$here/packages.txt")
    return 0
}

# Prints those of the packages given that are not installed.
missing_packages() {
    local package status
    for package in "$@"; do
        status=$(dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null || true)
        [[ $status == *installed* && $status != *not-installed* ]] || printf '%s\n' "$package"
    done
}

install_packages() {
    local as_root=()
    if [[ $(id -u) != 0 ]]; then
        command -v sudo >/dev/null || fail "these packages are missing and this user is neither root nor has sudo: $*
  remedy: as root, run  apt-get update && apt-get install --no-install-recommends $*"
        as_root=(sudo)
    fi
    printf 'setup: installing %s\n' "$*"
    # An update that fails in part (a dead third-party source) need not keep the packages away; the install tells.
    "${as_root[@]}" apt-get update -q || printf 'setup: apt-get update failed, trying with the lists that are there\n' >&2
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -q -y --no-install-recommends "$@" || fail "apt-get could not install: $*
  remedy: read apt's message above; the packages are those of Debian 12 and 13 (tools/packages.txt)"
}

[[ $# -gt 0 ]] || fail "which groups? e.g. tools/setup.sh build test (see tools/packages.txt)"
[[ ${ROBOSS_SKIP_SETUP:-} != 1 ]] || exit 0
command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || fail "this is no Debian system
  remedy: install the counterparts of tools/packages.txt by hand and set ROBOSS_SKIP_SETUP=1"
mapfile -t wanted < <(wanted_packages "$@")
[[ ${#wanted[@]} -gt 0 ]] || fail "no packages for $(release) in: $*"
mapfile -t missing < <(missing_packages "${wanted[@]}")
[[ ${#missing[@]} -eq 0 ]] || install_packages "${missing[@]}"
