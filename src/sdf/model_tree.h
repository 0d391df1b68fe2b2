// ModelTree: a model as its file means it. Nested models are found, included ones read, merged ones taken
// apart; names are checked; every frame has its pose and the link that it moves with (sdformat.org, "Pose
// Frame Semantics").
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "math/pose.h"
#include "sdf/element_reader.h"
#include "sdf/include_store.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

inline constexpr const char* kModelFrame = "__model__";

struct ModelTree;

/// A part of a model with a name, and so with a frame: a nested model, link, joint or frame.
struct TreePart {
    enum class Kind { kModel, kLink, kJoint, kFrame };  // in the order in which their names count
    Kind kind = Kind::kLink;
    Element source;  // of the frame of a merged model: its <include>
    std::string name;
    Pose X_MP;           // in the model frame
    std::string body;    // the link that it moves with, of a joint the child; empty: none (reported)
    std::string parent;  // of a joint: the parent link, or "world"
    std::string model_frame = kModelFrame;   // what its own file calls __model__
    std::shared_ptr<const ModelTree> model;  // of a nested model
};

struct ModelTree {
    Element source;
    bool is_static = false;
    std::string canonical_link;   // "nested::link" too; empty: there is none (reported)
    std::vector<TreePart> parts;  // by kind, then as in the file
    std::vector<std::pair<Element, Pose>>
        merged;  // models whose parts stand here, with their frames' poses X_MN

    /// The pose in the model frame of "link", "frame", "joint", "nested" or "nested::link" with all joints at
    /// zero; nullopt: there is no such name.
    std::optional<Pose> pose_of(const std::string& name) const;
    /// The link, named from this model, that such a frame moves with.
    std::optional<std::string> body_of(const std::string& name) const;
    /// The pose of an element with a <pose> (a collision, a sensor) in the frame of the part that holds it.
    Pose pose_in(const TreePart& holder, const Element& posed, const ElementReader& reader) const;
    /// The direction of an <axis>, in the frame of its joint.
    Vec3 direction_of(const TreePart& joint, const Element& axis, const ElementReader& reader) const;

    /// A name as the part that has it, and the rest of the name in that nested model.
    struct Named {
        std::size_t part = 0;
        std::string rest;
    };
    std::optional<Named> locate(const std::string& name) const;

    std::unordered_map<std::string, std::size_t> by_name;  // into `parts`
};

/// Reads a model without its own <pose>, which belongs to its place. What is wrong is reported.
std::unique_ptr<ModelTree> read_model_tree(const Element& model, IncludeStore& includes,
                                           const ElementReader& reader);

}  // namespace roboss::sdf_import
