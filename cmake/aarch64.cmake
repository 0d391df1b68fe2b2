# Cross-compiles for aarch64 by Debian's g++-aarch64-linux-gnu, with Debian's libraries for arm64 installed beside the
# host's (multiarch). tools/check_aarch64 makes such a root, builds there, and plays the golden runs under qemu.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
