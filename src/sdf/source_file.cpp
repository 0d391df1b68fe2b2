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
    return parse_version(file.root().attribute("version").value());
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
