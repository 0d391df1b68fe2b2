// SavedState: the <state> of a world that Gazebo has saved: where its models and links are and how they move,
// which models came and which went. The first <state> counts, as in Gazebo.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "sdf/placements.h"
#include "sdf/scaled_model.h"

namespace roboss::sdf_import {

class SavedState {
  public:
    /// Reads the <state> of this world, if it has one; what has no effect is reported.
    SavedState(const Element& world, const Import& import);

    /// Adds the models of <insertions>, and removes those of <deletions>.
    void change(std::vector<Placement>& placements, IncludeStore& includes, const Import& import) const;

    /// Puts the instance where its model is in the state; false: what the state says of it is wrong
    /// (reported).
    bool apply(ModelInstance& instance, const ModelSpec& spec, Diagnostics& diagnostics);
    /// The prototype of the model with this name: `prototype`, or one with the sizes that the state gives it,
    /// which is appended to those of the world.
    std::size_t scaled(const std::string& name, std::size_t prototype, World& world);
    /// Notes models of the state that the world does not have.
    void report_unused(Diagnostics& diagnostics) const;

  private:
    struct SavedModel {
        Element where;
        std::optional<Pose> X_WM;
        std::vector<LinkStart> links;
        std::vector<AxisStart> axes;
        ModelScale scale;
        bool is_wrong = false;
        bool is_used = false;
    };
    static void read_model(const Element& element, const std::string& prefix, const Import& import,
                           SavedModel& model);
    static void read_links(const Element& element, const std::string& prefix, const Import& import,
                           SavedModel& model);
    static void read_axes(const Element& element, const std::string& prefix, const Import& import,
                          SavedModel& model);

    Element state_;
    std::unordered_map<std::string, SavedModel> models_;
    struct Scaled {
        std::size_t from = 0, to = 0;  // in World::prototypes
        ModelScale scale;
    };
    std::vector<Scaled> scaled_;
};

}  // namespace roboss::sdf_import
