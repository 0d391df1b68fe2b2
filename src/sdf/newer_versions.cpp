// The table of elements newer than SDFormat 1.9, with what becomes of each.
#include "sdf/newer_versions.h"

#include <algorithm>
#include <cstring>

namespace roboss::sdf_import {
namespace {

struct NewerElement {
    const char* parent;
    const char* name;
    const char* consequence;  // nullptr: the importer honours or reports it elsewhere
    const char* remedy;
};

constexpr NewerElement kNewer[] = {
    {"axis", "mimic", nullptr, nullptr},
    {"axis2", "mimic", nullptr, nullptr},
    {"inertial", "fluid_added_mass", nullptr, nullptr},
    {"inertial", "density", nullptr, nullptr},
    {"inertial", "auto_inertia_params", "parameters of a mesh's automatic inertia are ignored",
     "Write the link's <mass> and <inertia>."},
    {"collision", "auto_inertia_params", "parameters of a mesh's automatic inertia are ignored",
     "Write the link's <mass> and <inertia>."},
    {"collision", "density", nullptr, nullptr},
    {"geometry", "cone", nullptr, nullptr},
    {"mesh", "convex_decomposition", nullptr, nullptr},
    {"joint", "screw_thread_pitch", nullptr, nullptr},
};

struct NewerAttribute {
    const char* element;
    const char* name;
    const char* consequence;
    const char* remedy;
};

constexpr NewerAttribute kNewerAttributes[] = {
    {"inertial", "auto", nullptr, nullptr},
    {"mesh", "optimization", nullptr, nullptr},
};

const NewerElement* find_newer(const Element& element) {
    for (const NewerElement& newer : kNewer) {
        if (std::strcmp(element.node.name(), newer.name) == 0 &&
            std::strcmp(element.node.parent().name(), newer.parent) == 0) {
            return &newer;
        }
    }
    return nullptr;
}

std::string version_text(int version) {
    return std::to_string(version / 100) + "." + std::to_string(version % 100);
}

}  // namespace

std::string libsdformat_version(int version) {
    return version == 0 ? version_text(kNewestKnownToLibsdformat)
                        : version_text(std::min(version, kNewestKnownToLibsdformat));
}

bool known_to_libsdformat(const Element& element) {
    return find_newer(element) == nullptr;
}

bool attribute_known_to_libsdformat(const Element& element, const std::string& attribute) {
    return std::none_of(
        std::begin(kNewerAttributes), std::end(kNewerAttributes), [&](const NewerAttribute& newer) {
            return attribute == newer.name && std::strcmp(element.node.name(), newer.element) == 0;
        });
}

void report_newer_elements(const Element& model, Diagnostics& diagnostics) {
    for (const auto node : model.node.children()) {
        if (node.type() != pugi::node_element || std::strcmp(node.name(), "plugin") == 0) continue;
        const Element element{model.source, node};
        if (const NewerElement* newer = find_newer(element);
            newer != nullptr && newer->consequence != nullptr) {
            diagnostics.warning(
                element.where(), "newer-element",
                "<" + std::string(newer->name) + "> in <" + newer->parent + ">: " + newer->consequence,
                newer->remedy);
        }
        for (const NewerAttribute& newer : kNewerAttributes) {
            if (newer.consequence == nullptr || std::strcmp(node.name(), newer.element) != 0) continue;
            if (node.attribute(newer.name)) {
                diagnostics.warning(
                    element.where(), "newer-element",
                    std::string(newer.name) + "=\"...\" of <" + newer.element + ">: " + newer.consequence,
                    newer.remedy);
            }
        }
        report_newer_elements(element, diagnostics);
    }
}

void check_version(const SourceFile& file, Diagnostics& diagnostics) {
    const SourceLocation where = file.where(file.root());
    const std::string written = file.root().attribute("version").value();
    if (version_of(file) == 0) {
        diagnostics.warning(where, "no-version",
                            "<sdf> has " +
                                (written.empty() ? "no version" : "the version '" + written + "'") +
                                "; the file is read as 1.9",
                            "Write <sdf version=\"1.9\">, or the version that the file was made for.");
    } else if (version_of(file) < kOldestVersion) {
        diagnostics.warning(where, "old-version",
                            "SDFormat " + written + " is older than 1.4, the oldest that is supported",
                            "Convert it with: gz sdf -p FILE.");
    } else if (version_of(file) > kNewestKnownHere) {
        diagnostics.warning(where, "newer-version",
                            "SDFormat " + written + " is newer than 1.12; elements it adds may be missed",
                            "Look through the other diagnostics; elements that are not known are reported.");
    }
}

}  // namespace roboss::sdf_import
