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

supported=" bookworm trixie "
by_hand="install the counterparts of tools/packages.txt by hand and set ROBOSS_SKIP_SETUP=1"

# A release that the list does not know may have the packages under the same names, as Ubuntu mostly does. A group whose
# names differ between releases would be installed in part, so that is an error.
check_release() {
    local name group package mark
    name=$(. "${ROBOSS_OS_RELEASE:-/etc/os-release}" 2>/dev/null && printf '%s' "${PRETTY_NAME:-${VERSION_CODENAME:-}}") || true
    [[ $supported != *" $(release) "* ]] || return 0
    while read -r group package mark _; do
        [[ $mark != only=* || " $* " != *" $group "* || $group == oracle || $group == check ]] || fail \
            "${name:-this system} is not supported, and $package of the group $group has another name there
  remedy: use Debian 12 or 13, or $by_hand"
    done < <(grep -v '^#' "$here/packages.txt")
    printf 'setup: %s is not supported (Debian 12 and 13 are); trying its packages of the same names\n' "${name:-this system}" >&2
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
    # The words are kept in memory: on a full disk, a file of them would be empty.
    local words
    {
        words=$("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 \
            apt-get install -q -y --no-install-recommends "$@" 2>&1 | show_and_pass) || explain "$words" "$@"
    } 3>&1
}

# Prints each line to descriptor 3 at once, and passes it on.
show_and_pass() {
    local line
    while IFS= read -r line || [[ -n $line ]]; do
        printf '%s\n' "$line" >&3
        printf '%s\n' "$line"
    done
}

# Ends with the reason why apt-get did not install the packages, from its words.
explain() {
    local words=$1 unknown
    shift
    unknown=$(grep -oE "Unable to locate package [^ ]+|Package '?[^ ']+'? has no installation candidate" <<<"$words" |
        sed -E "s/Unable to locate package //; s/Package '?([^ ']+).*/\1/" | sort -u | tr '\n' ' ') || true
    if grep -qiE "No space left on device|enough free space" <<<"$words"; then
        fail "the disk is full, apt-get could not install: $*
  remedy: free some space, e.g. by  apt-get clean  (df -h shows which disk is full), and start again"
    elif [[ -n $unknown ]]; then
        # Without a network there may be no lists at all.
        fail "this system's package lists do not have: $unknown
  remedy: is the network there, and does  apt-get update  work? The packages are those of Debian 12 and 13 (main);
  elsewhere, $by_hand"
    elif grep -qiE "Temporary failure resolving|Could not resolve|Could not connect|Unable to connect|unreachable|Failed to fetch" <<<"$words"; then
        fail "no network: apt-get could not fetch: $*
  remedy: connect this machine, or name a proxy (http_proxy=..., or Acquire::http::Proxy in /etc/apt/apt.conf.d)"
    fi
    fail "apt-get could not install: $*
  remedy: read apt's message above; the packages are those of Debian 12 and 13 (tools/packages.txt)"
}

[[ $# -gt 0 ]] || fail "which groups? e.g. tools/setup.sh build test (see tools/packages.txt)"
[[ ${ROBOSS_SKIP_SETUP:-} != 1 ]] || exit 0
command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || fail "this is no Debian system
  remedy: $by_hand"
mapfile -t wanted < <(wanted_packages "$@")
[[ ${#wanted[@]} -gt 0 ]] || fail "no packages for $(release) in: $*"
mapfile -t missing < <(missing_packages "${wanted[@]}")
[[ ${#missing[@]} -gt 0 ]] || exit 0
check_release "$@"
install_packages "${missing[@]}"
