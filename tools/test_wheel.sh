#!/usr/bin/env bash
# Runs tests of the Python package against the wheel in dist/: `tools/test_wheel.sh [arguments of pytest]`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
python=$(tools/python_env.sh)
exec "$python" -B -m pytest -q -p no:cacheprovider -c python/pyproject.toml "${@:-python/tests}"
