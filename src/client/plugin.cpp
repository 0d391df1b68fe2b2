// dlopen and the two entry points of a control program.
#include "client/plugin.h"

#include <dlfcn.h>

#include <exception>
#include <filesystem>

#include "client/user_code.h"
#include "core/error_text.h"

namespace roboss {

namespace {

constexpr const char* kRemedy =
    "put ROBOSS_CONTROL_PROGRAM(YourClass) into one source file and link it as a shared library against "
    "roboss::client";

std::string loader_says() {
    const char* text = dlerror();
    return text == nullptr ? "no reason given" : text;
}

}  // namespace

Result<std::unique_ptr<ControlProgram>> load_control_program(const std::string& path) {
    std::error_code error;
    const std::filesystem::path file = std::filesystem::absolute(path, error);
    if (error || !std::filesystem::is_regular_file(file, error))
        return Error{"control program " + path + ": there is no such file",
                     "give the path of a shared library (.so)", "no-file"};
    const UserCode mark(path, "its initialization");
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
        return Error{"control program " + path + " cannot be loaded: " + loader_says(), kRemedy,
                     "not-loadable"};
    using Version = int();
    using Make = ControlProgram*();
    auto* version = reinterpret_cast<Version*>(dlsym(library, "roboss_control_program_abi"));
    auto* make = reinterpret_cast<Make*>(dlsym(library, "roboss_control_program"));
    if (version == nullptr || make == nullptr)
        return Error{"control program " + path + " has no entry point: " + loader_says(), kRemedy,
                     "no-entry-point"};
    if (const int abi = version(); abi != kControlProgramAbi)
        return Error{"control program " + path + " was built for interface version " + std::to_string(abi) +
                         ", this is version " + std::to_string(kControlProgramAbi),
                     abi < kControlProgramAbi ? "build it again against this version of RoBOSS"
                                              : "update this RoBOSS (the Python package: "
                                                "tools/build_wheel.sh), or build it against this version",
                     "abi-mismatch"};
    try {
        std::unique_ptr<ControlProgram> program(make());
        if (program) return program;
        return Error{"control program " + path + ": its entry point gave nothing", kRemedy};
    } catch (const std::exception& e) {
        return error_of_text("control program " + path + ": its constructor threw: ", e.what(),
                             "fix the control program", "");
    } catch (...) {
        return Error{"control program " + path + ": its constructor threw something",
                     "fix the control program"};
    }
}

}  // namespace roboss
