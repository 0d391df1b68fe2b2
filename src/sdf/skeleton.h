// A skeleton is what libsdformat gets to read of a model: links, joints, frames, nested models, and the
// shapes and inertias with their numbers masked (we read those ourselves, from the source). So models that
// differ only in sizes, masses or colours share one reading, and each of its lines still leads to the element
// of the source file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sdf/source_file.h"

namespace roboss::sdf_import {

struct Skeleton {
    std::string head;            // <sdf><model name="...">: differs between models that may share a reading
    std::string body;            // the rest
    std::vector<Element> lines;  // lines[i]: the element that line i + 1 of head + body begins

    std::string text() const { return head + body; }
};

/// Where nested <include>s lead: a file with the skeleton of what they include.
class SkeletonIncludes {
  public:
    virtual ~SkeletonIncludes() = default;
    virtual std::optional<std::string> skeleton_file(const Element& include) = 0;
};

/// A model's own pose and placement frame: left out for a model of the world (they belong to its place there,
/// so that equal models have equal skeletons), kept for a model that is included in a model.
enum class TopPose { kLeftOut, kKept };

/// The name that a part of a link has for libsdformat, which refuses two of one kind with one name.
std::string name_among_siblings(const Element& part);

Skeleton make_skeleton(const Element& model, TopPose pose, SkeletonIncludes& includes);

}  // namespace roboss::sdf_import
