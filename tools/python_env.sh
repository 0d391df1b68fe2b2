#!/usr/bin/env bash
# Makes build/python/venv, an environment with the packages of tools/python_packages.txt, and prints the path of its
# Python. Nothing happens where it is up to date. PYTHON names the Python that it is made with.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
packages=tools/python_packages.txt
venv=$PWD/build/python/venv
mkdir -p "$(dirname "$venv")"
exec 9>"$venv.lock"
flock 9  # another start may be making it
stamp="$(${PYTHON:-python3} -c 'import sys; print(sys.executable, sys.version)') $(cat "$packages")"
if [[ ! -f $venv/stamp || $(cat "$venv/stamp") != "$stamp" ]]; then
    rm -rf "$venv"
    "${PYTHON:-python3}" -m venv "$venv" >&2 || {
        printf 'python_env: %s cannot make an environment\n  remedy: tools/setup.sh python\n' "${PYTHON:-python3}" >&2
        exit 1
    }
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r "$packages" >&2 || {
        printf 'python_env: pip could not install the packages of %s (its message is above)\n' "$packages" >&2
        printf '  remedy: no network, a full disk (df -h), or a Python without wheels of them? PYTHON=... names another one\n' >&2
        exit 1
    }
    printf '%s\n' "$stamp" >"$venv/stamp"
fi
printf '%s\n' "$venv/bin/python"
