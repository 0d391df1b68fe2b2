#!/usr/bin/env bash
# Builds the viewer's page: `tools/build_web.sh FOLDER [--tests]` (--tests: the page's tests and the mock gateway too, into
# web/.tests). Its packages come from npm only when web/package-lock.json changed; later builds need no network.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
    printf 'build_web: %s\n' "$*" >&2
    exit 1
}

[[ $# -ge 1 ]] || fail "which folder? e.g. tools/build_web.sh build/release/share/roboss/web"
folder=$(realpath -m "$1")
shift
for program in node npm; do
    command -v "$program" >/dev/null || fail "$program is missing
  remedy: tools/setup.sh build, or build without the page: -DROBOSS_WEB=OFF"
done
major=$(node -p 'process.versions.node.split(".")[0]')
[[ $major -ge 18 ]] || fail "node is of version $major, the page needs 18 or later"

# Two presets may be built at once; they share web/node_modules.
exec 9>web/.build-lock
flock 9
wanted="$(sha256sum <web/package-lock.json) node $major $(uname -m)"
stamp=web/node_modules/.roboss-stamp
if [[ ! -f $stamp || $(<"$stamp") != "$wanted" ]]; then
    printf 'build_web: fetching the packages that web/package-lock.json names\n'
    # No package runs a script of its own here: esbuild's program lies in a package and works as it is.
    (cd web && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error) || fail "npm could not fetch the page's packages
  remedy: read npm's message above; without a network, build without the page: -DROBOSS_WEB=OFF"
    printf '%s\n' "$wanted" >"$stamp"
fi
cd web && node build.mjs "$folder" "$@"
