// `<plugin>` elements: on-board controllers where there is a counterpart, else a word about what becomes of
// them.
#pragma once

#include <optional>
#include <string>

#include "sdf/conversion.h"

namespace roboss::sdf_import {

/// Class and file of a plugin without what changes from release to release: "DiffDrive", "diff-drive-system".
struct PluginName {
    std::string class_name;  ///< without namespace; empty: the name is no class
    std::string file;        ///< without "lib", ".so", "gz-sim-", "ignition-gazebo-"
};
PluginName plugin_name(const Element& plugin);
/// Whether the plugin has one of the classes ("A|B") or, if it names no class, one of the files.
bool is_named(const PluginName& name, const char* classes, const char* files);

/// The plugin as the file has it, and where it stands; it does not run. `scope`: see convert_plugin().
ExtensionElement kept_element(const Element& plugin, const std::string& scope = "");

/// Keeps the plugin and says what becomes of it: an on-board controller is appended to `onboard`; what has no
/// counterpart gets a note. `scope` is the prefix of names in a nested model ("inner::" or "").
void convert_plugin(const Element& plugin, const std::string& scope, const Import& import,
                    std::vector<OnboardSpec>& onboard, std::vector<ExtensionElement>& kept);

/// <roboss:gripper> of a link: an on-board controller too.
void convert_gripper(const Element& gripper, const Element& link, const std::string& scope,
                     const Import& import, std::vector<OnboardSpec>& onboard);

}  // namespace roboss::sdf_import
