// Makes a program of the headers that tests share, so that CMake precompiles them (cmake/test_options.cmake).
#include <support/test_headers.h>

int main() {
    return 0;
}
