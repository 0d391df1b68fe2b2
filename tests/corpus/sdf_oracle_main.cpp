// Says what libsdformat makes of a file, with the resource folders given: the yardstick of
// tools/check_corpus. Usage: sdf_oracle FILE [FOLDER...] Prints "refused: " and libsdformat's first error; or
// "accepted", what was compared, and each difference from our own reading. Exit codes: 0 the same, 1 refused,
// 2 wrong usage, 3 differences.
#include <iostream>

#include "corpus/sdf_oracle.h"

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: sdf_oracle FILE [FOLDER...]\n";
        return 2;
    }
    const auto verdict = roboss::corpus::ask_libsdformat(argv[1], {argv + 2, argv + argc});
    if (!verdict.refusal.empty()) {
        std::cout << "refused: " << verdict.refusal << '\n';
        return 1;
    }
    std::cout << "accepted, compared " << verdict.models << " models, " << verdict.links << " links, "
              << verdict.joints << " joints\n";
    for (const std::string& difference : verdict.differences) std::cout << "differs: " << difference << '\n';
    return verdict.differences.empty() ? 0 : 3;
}
