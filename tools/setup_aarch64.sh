#!/usr/bin/env bash
# Installs what cross-compiles for aarch64 and plays it, in a root of Debian 12 (tools/check_aarch64, tools/release.sh): the
# group aarch64 of tools/packages.txt, and the libraries of the group build, and Python's headers, as packages for arm64.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if ! dpkg --print-foreign-architectures | grep -qx arm64; then
    dpkg --add-architecture arm64
    apt-get update -q
fi
tools/setup.sh aarch64
mapfile -t libraries < <(awk '$1 == "build" && $2 ~ /-dev$/ { print $2 ":arm64" }' tools/packages.txt)
DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends libpython3-dev:arm64 "${libraries[@]}"
