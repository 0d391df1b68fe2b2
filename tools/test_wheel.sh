#!/usr/bin/env bash
# Runs tests of the Python package against the wheel in dist/: `tools/test_wheel.sh [arguments of pytest]`; paths are
# absolute or start at python/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
python=$(tools/python_env.sh)
cd python
exec "$python" -P -B -m pytest -q -p no:cacheprovider "$@"
