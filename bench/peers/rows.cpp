// See rows.h.
#include "peers/rows.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

namespace roboss::bench {
namespace {

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

}  // namespace

void print_table(const std::vector<Row>& rows) {
    std::printf("%-8s %6s  %-22s %9s %17s %7s %6s %10s  %s\n", "scene", "robots", "engine", "us/step",
                "least - most", "ratio", "steps", "bytes", "result");
    for (const Row& row : rows) {
        std::printf("%-8s %6zu  %-22s ", row.scene.c_str(), row.robots, row.engine.c_str());
        if (!row.skipped.empty()) {
            std::printf("left out: %s\n", row.skipped.c_str());
            continue;
        }
        std::printf("%9.3f %8.3f -%7.3f %7.2f %6d %10.0f  %s%s\n", row.us_median, row.us_least, row.us_most,
                    row.ratio, row.steps, row.bytes_per_robot,
                    row.right ? "" : "WRONG: ", row.verdict.c_str());
    }
}

bool write_json(const std::string& path, const std::vector<Row>& rows) {
    const char* commit = std::getenv("ROBOSS_COMMIT");  // set by bench.sh
    nlohmann::ordered_json all;
    all["commit"] = commit != nullptr ? commit : "unknown";
    all["compiler"] = ROBOSS_COMPILER;
    all["cpu"] = processor();
    for (const Row& row : rows)
        all["rows"].push_back({{"scene", row.scene},
                               {"robots", row.robots},
                               {"engine", row.engine},
                               {"settings", row.settings},
                               {"skipped", row.skipped},
                               {"steps", row.steps},
                               {"us_median", row.us_median},
                               {"us_least", row.us_least},
                               {"us_most", row.us_most},
                               {"ratio", row.ratio},
                               {"build_s", row.build_s},
                               {"bytes_per_robot", row.bytes_per_robot},
                               {"right", row.right},
                               {"verdict", row.verdict}});
    std::ofstream file(path);
    file << all.dump(1) << "\n";
    if (file.flush()) return true;
    std::fprintf(stderr, "roboss-peers: cannot write %s; choose another file with --json\n", path.c_str());
    return false;
}

}  // namespace roboss::bench
