"""What the tools that put Debian's libraries into a release share: the package of a library, and its licence."""
import shutil
import subprocess

# Packages of headers whose code is compiled into the programs. The other packages of the group build are shared libraries.
HEADERS = ("libboost-dev", "libcli11-dev", "libspdlog-dev", "libtomlplusplus-dev", "nlohmann-json3-dev")


def package_of(library):
    """The Debian package that this file, or the one that it links to, came with; None if there is none."""
    for path in (library, library.resolve()):
        found = subprocess.run(["dpkg-query", "-S", str(path)], capture_output=True, text=True, check=False)
        if found.returncode == 0:
            return found.stdout.split(":")[0]
    return None


def copy_licence(package, folder):
    """Copies the licence of an installed package into a folder, as PACKAGE.txt."""
    shutil.copy(f"/usr/share/doc/{package}/copyright", folder / f"{package}.txt")


def copy_licences_of_headers(folder):
    """The same for the packages of headers."""
    for package in HEADERS:
        copy_licence(package, folder)
