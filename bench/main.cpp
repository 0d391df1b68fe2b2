// Google Benchmark's main, which also writes down what the numbers depend on: commit, compiler, processor.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace {

/// The processor's name, as Linux tells it.
std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

}  // namespace

int main(int argc, char** argv) {
    const char* commit = std::getenv("ROBOSS_COMMIT");  // set by bench.sh
    benchmark::AddCustomContext("commit", commit != nullptr ? commit : "unknown");
    benchmark::AddCustomContext("compiler", ROBOSS_COMPILER);
    benchmark::AddCustomContext("cpu", processor());
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    if (benchmark::RunSpecifiedBenchmarks() == 0) return 1;  // no benchmark of that name
    benchmark::Shutdown();
    return 0;
}
