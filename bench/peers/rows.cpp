// See rows.h.
#include "peers/rows.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "peers/price_list.h"

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
    std::printf("%-10s %6s  %-22s %9s %17s %7s %9s %6s %10s  %s\n", "scene", "robots", "engine", "us/step",
                "least - most", "ratio", "real time", "steps", "bytes", "result");
    for (const Row& row : rows) {
        std::printf("%-10s %6zu  %-22s ", row.scene.c_str(), row.robots, row.engine.c_str());
        if (!row.skipped.empty()) {
            std::printf("left out: %s\n", row.skipped.c_str());
            continue;
        }
        std::printf("%9.3f %8.3f -%7.3f %7.2f %9.3g %6d %10.0f  %s%s\n", row.us_median, row.us_least,
                    row.us_most, row.ratio, row.real_time_factor, row.steps, row.bytes_per_robot,
                    row.right ? "" : "WRONG: ", row.verdict.c_str());
    }
}

namespace {

/// Where and of what figures were taken.
nlohmann::ordered_json origin() {
    const char* commit = std::getenv("ROBOSS_COMMIT");  // set by bench.sh
    nlohmann::ordered_json json;
    json["commit"] = commit != nullptr ? commit : "unknown";
    json["compiler"] = ROBOSS_COMPILER;
    json["cpu"] = processor();
    return json;
}

bool write(const std::string& path, const nlohmann::ordered_json& json) {
    std::ofstream file(path);
    file << json.dump(1) << "\n";
    if (file.flush()) return true;
    std::fprintf(stderr, "roboss-peers: cannot write %s; choose another file with --json\n", path.c_str());
    return false;
}

}  // namespace

bool write_json(const std::string& path, const std::vector<Row>& rows) {
    nlohmann::ordered_json all = origin();
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
                               {"real_time_factor", row.real_time_factor},
                               {"build_s", row.build_s},
                               {"bytes_per_robot", row.bytes_per_robot},
                               {"right", row.right},
                               {"verdict", row.verdict}});
    return write(path, all);
}

bool write_json(const std::string& path, const std::vector<Price>& prices) {
    nlohmann::ordered_json all = origin();
    for (const Price& p : prices)
        all["prices"].push_back({{"scene", p.scene},
                                 {"robots", p.robots},
                                 {"setting", p.setting},
                                 {"skipped", p.skipped},
                                 {"steps", p.cost.steps},
                                 {"us_median", p.cost.us_median},
                                 {"us_least", p.cost.us_least},
                                 {"us_most", p.cost.us_most},
                                 {"ratio_to_standard", p.cost.ratio},
                                 {"iterations_an_island", p.solver.iterations},
                                 {"residual", p.solver.residual},
                                 {"friction_error", p.solver.friction_error},
                                 {"friction_misses", p.solver.friction_misses},
                                 {"overlap_m", p.overlap_m},
                                 {"right", p.cost.right},
                                 {"verdict", p.cost.verdict}});
    return write(path, all);
}

}  // namespace roboss::bench
