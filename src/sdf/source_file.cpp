// See source_file.h.
#include "sdf/source_file.h"

#include <charconv>

#include "sdf/actor_conversion.h"

namespace roboss::sdf_import {

int parse_version(const std::string& text) {
    int major = 0, minor = 0;
    const char* end = text.data() + text.size();
    const auto [dot, error] = std::from_chars(text.data(), end, major);
    if (error != std::errc{} || dot == end || *dot != '.') return 0;
    const auto [rest, minor_error] = std::from_chars(dot + 1, end, minor);
    if (minor_error != std::errc{} || rest != end || major < 1 || minor < 0 || minor > 99) return 0;
    return major * 100 + minor;
}

int version_of(const SourceFile& file) {
    const int version = parse_version(file.root().attribute("version").value());
    return version == 0 ? kAssumedVersion : version;
}

void check_version(const SourceFile& file, Diagnostics& diagnostics) {
    const SourceLocation where = file.where(file.root());
    const std::string written = file.root().attribute("version").value();
    if (parse_version(written) == 0)
        diagnostics.warning(where, "no-version",
                            "<sdf> has " +
                                (written.empty() ? "no version" : "the version '" + written + "'") +
                                "; the file is read as 1.9",
                            "Write <sdf version=\"1.9\">, or the version that the file was made for.");
    else if (version_of(file) < kOldestVersion)
        diagnostics.warning(where, "old-version",
                            "SDFormat " + written + " is older than 1.4, the oldest that is supported",
                            "Convert it with: gz sdf -p FILE.");
    else if (version_of(file) > kNewestVersion)
        diagnostics.warning(where, "newer-version",
                            "SDFormat " + written + " is newer than 1.12; elements it adds may be missed",
                            "Look through the other diagnostics; elements that are not known are reported.");
}

std::string name_of_joint(pugi::xml_node joint) {
    const auto own = joint.attribute(kJointName);
    return (own ? own : joint.attribute("name")).value();
}

std::unique_ptr<SourceFile> read_source(const std::string& path, Diagnostics& diagnostics) {
    auto file = SourceFile::read(path, diagnostics);
    if (file) make_models_of_actors(file->root());
    return file;
}

}  // namespace roboss::sdf_import
