// See python_command.h.
#include "app/commands/python_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "app/commands/exit_codes.h"
#include "app/output/say.h"
#include "core/result.h"

namespace roboss {
namespace {

/// Runs the command of the package, or says that there is none. The folder of work is not searched for it.
const char* const kPythonProgram = R"(import sys
sys.path = [folder for folder in sys.path if folder]
try:
    from roboss.analysis.command import main
except ImportError as missing:
    sys.stderr.write(f"""roboss: '{sys.argv[1]}' needs the Python package 'roboss', which {sys.executable} does not have ({missing}) [no-package]
  remedy: `pip install 'roboss-...whl[analysis]'` with the wheel of this version (tools/build_wheel.sh makes it in dist/), and set ROBOSS_PYTHON to that Python
""")
    sys.exit(1)
main(sys.argv[1:]))";

/// Returns only where Python cannot be started.
int become_python(const std::string& name, const std::vector<std::string>& arguments) {
    const char* chosen = std::getenv("ROBOSS_PYTHON");
    const std::string python = chosen != nullptr && *chosen != '\0' ? chosen : "python3";
    std::vector<const char*> words{python.c_str(), "-c", kPythonProgram, name.c_str()};
    for (const std::string& argument : arguments) words.push_back(argument.c_str());
    words.push_back(nullptr);
    execvp(words[0], const_cast<char* const*>(words.data()));
    const Error error{fmt::format("'roboss {}' runs in Python, and '{}' cannot be started: {}", name, python,
                                  std::strerror(errno)),
                      "install Python 3.11 or newer with the package 'roboss', and set ROBOSS_PYTHON to it",
                      "no-python"};
    say(stderr, "roboss: {}\n", error.text());
    return kBadInput;
}

}  // namespace

void add_python_commands(CLI::App& app, int& exit_code) {
    const std::pair<const char*, const char*> commands[] = {
        {"record", "writes variables of a world or a journal over time, as Parquet or MCAP (Python package)"},
        {"plot", "draws variables of a recording over time (Python package)"},
        {"analyse", "makes reports on arms (ISO 9283), vehicles and walkers (Python package)"},
        {"calibrate", "fits numbers of a world file to recorded runs of the real robot (Python package)"}};
    for (const auto& [name, what] : commands) {
        CLI::App* command = app.add_subcommand(name, what);
        command->prefix_command();
        command->set_help_flag();  // Python's has the options
        command->set_help_all_flag();
        command->callback(
            [command, &exit_code] { exit_code = become_python(command->get_name(), command->remaining()); });
    }
}

}  // namespace roboss
