// What a URDF robot consists of, by name, and how each part is written as SDF.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "sdf/sdf_text.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// The parts of a <robot>, found once. Nodes are those of the file, with its repairs.
struct UrdfRobot {
    const SourceFile& urdf;
    Diagnostics& diagnostics;
    pugi::xml_node robot;
    std::map<std::string, pugi::xml_node> links{}, joints{}, materials{};
    std::map<std::string, pugi::xml_node> carriers{};  // by link: the joint that has it as child
    std::map<std::string, std::vector<pugi::xml_node>> extensions{};  // <gazebo reference="...">
    std::map<std::string, std::string> positions{};                   // that joints start at
    bool masses_follow = false;  // from the collisions: the file has none

    SourceLocation where(pugi::xml_node node) const { return urdf.where(node); }
    pugi::xml_node find_link(const std::string& name) const;
    /// The joint that carries the link; null: it is a root.
    pugi::xml_node carrier_of(const std::string& link) const;
    const std::vector<pugi::xml_node>& extensions_of(const std::string& name) const;
    /// A link that holds nothing, and that a fixed joint puts on another one: only a name for a place.
    bool is_frame(const std::string& link) const;
    /// A link that has no part in what moves: the world, or only a name for a place in it.
    bool is_left_out(const std::string& link) const;
    /// The name of a joint in SDF, where links and joints share one set of names, which holds "world".
    std::string sdf_name_of(pugi::xml_node joint) const;
};

std::string name_of(pugi::xml_node node);
std::string parent_of(pugi::xml_node joint);
std::string child_of(pugi::xml_node joint);
std::string type_of(pugi::xml_node joint);
bool moves(pugi::xml_node joint);
bool has_mass(pugi::xml_node link);
/// Neither mass nor shapes.
bool is_bare(pugi::xml_node link);

/// Parts by name. False, and errors: a link has two parents, or hangs on itself.
bool index_parts(UrdfRobot& robot);

/// A <pose> of an element's <origin>, if it has one.
void write_origin(const UrdfRobot& robot, pugi::xml_node element, SdfText& out, pugi::xml_node to,
                  const std::string& relative_to = {});

void write_link(const UrdfRobot& robot, pugi::xml_node link, SdfText& out, pugi::xml_node model);
void write_joint(const UrdfRobot& robot, pugi::xml_node joint, SdfText& out, pugi::xml_node model);

/// The content of <gazebo reference="LINK"> for a link's collisions and visuals, and what it puts into the
/// link.
void extend_collision(const UrdfRobot& robot, const std::string& link, SdfText& out,
                      pugi::xml_node collision);
/// True if it gives the visual a material.
bool extend_visual(const UrdfRobot& robot, const std::string& link, SdfText& out, pugi::xml_node visual);
void extend_link(const UrdfRobot& robot, const std::string& link, SdfText& out, pugi::xml_node to);
void extend_joint(const UrdfRobot& robot, pugi::xml_node joint, SdfText& out, pugi::xml_node to);
/// <gazebo> without a reference; and warnings for references to nothing.
void extend_model(const UrdfRobot& robot, SdfText& out, pugi::xml_node model);

}  // namespace roboss::sdf_import
