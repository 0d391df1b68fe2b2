"""Run by the Python of a clean environment: the wheel alone is enough. Prints one line; asserts that the process maps
no library of the system beyond those that every Debian has."""
import re
import sys
from pathlib import Path

import roboss

OF_EVERY_DEBIAN = re.compile(r"(ld-linux-x86-64|libc|libm|libdl|libpthread|librt|libgcc_s|libstdc\+\+|libz)(\.so|-)")
# libzstd: the libcrypto of Debian 13 needs it.
OF_PYTHON = re.compile(r"(libpython3|libexpat|libffi|libssl|libcrypto|libuuid|liblzma|libbz2|libreadline|libtinfo|"
                       r"libsqlite3|libnsl|libtirpc|libb2|libmpdec|libzstd)")


def foreign_libraries(process="self", inside=(sys.prefix, sys.base_prefix + "/lib/python3")):
    """Shared libraries of this process from outside these folders that a bare Debian lacks."""
    mapped = {line.split(maxsplit=5)[5].strip() for line in Path(f"/proc/{process}/maps").read_text().splitlines()
              if ".so" in line and len(line.split(maxsplit=5)) == 6}
    outside = [path for path in mapped if not path.startswith(inside)]
    return [path for path in outside if not OF_EVERY_DEBIAN.match(Path(path).name)
            and not OF_PYTHON.match(Path(path).name)]


def main():
    sim = roboss.Simulation(roboss.example("city.sdf"), threads=2)
    sim.robots("car_*")["laser"].read()
    sim.step(1000)
    assert Path(roboss.__file__).is_relative_to(sys.prefix), roboss.__file__
    roboss.load(roboss.example("yard.sdf"))  # meshes: assimp
    assert not foreign_libraries(), foreign_libraries()
    print(sim.state_hash)


if __name__ == "__main__":
    main()
