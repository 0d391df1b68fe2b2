// What acts in a world: the commands that its robots take, and what becomes of each `<plugin>` in it.
#pragma once

#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "model/model.h"
#include "world/world.h"

namespace roboss {

/// The commands of robots of one type that have the same names, and how many robots these are.
struct TypeCommands {
    std::string first;       // name of the first of these robots
    std::size_t robots = 0;  // that share these names
    std::size_t alike =
        0;  // others of this type, whose names differ; 0 if an entry before this one counts them
    bool is_repeated = false;  // an entry before this one is of the same type
    bool is_board = false;     // the board that carries the messages of the world, no robot of the file
    std::vector<Channel> commands;
};

/// Types without commands are left out.
std::vector<TypeCommands> list_commands(const Model& model);

/// A `<plugin>` of the world and what becomes of it.
struct PluginReport {
    std::string model;      // the first model that has it; empty: the world
    std::string parent;     // the element that it is in: "world", "model", "link", "visual", "sensor"
    std::string owner;      // name of that, from its model down; empty: the model or world itself
    std::string name;       // class of the plugin, as it is written; else its file
    SourceLocation where;   // of the element
    std::size_t count = 1;  // models that have it
    PluginFate fate = PluginFate::kNotRun;
    std::string reason;  // that it does not run
};

/// All plugins in the order of the file. `model`: the compiled world, null: it cannot run. `diagnostics`: of
/// reading and compiling it; they say why a controller was left out.
std::vector<PluginReport> list_plugins(const World& world, const Model* model,
                                       const Diagnostics& diagnostics);

/// "runs", "not needed", "not run".
const char* to_text(PluginFate fate);

}  // namespace roboss
