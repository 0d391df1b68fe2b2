// A running world changed: a Model made of another one by adding robots, taking some away, or setting other
// accuracy, and the states and orders of the old one carried over. What is not named stays as it is, bit for
// bit.
//
// Canonical order: RobotIds count robots in the order in which they came, first those of the world file, and
// close the gap when one goes. So those that stay keep their order among each other, whatever happens.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/copy_place.h"
#include "model/order.h"

namespace roboss {

/// How high robots that come start.
enum class Standing {
    kAsPlaced,  ///< where they are put
    kOnGround   ///< on the scenery below, which includes that of the addition (model/on_ground.h)
};

/// The new Model, and how to get there from the old one.
struct ModelEdit {
    std::shared_ptr<const Model> model;  ///< the new one
    std::vector<RobotId> now;            ///< by the old RobotId: the new one; not valid: it is gone
    bool scenery_changed = false;        ///< all sleepers wake
    Diagnostics found{};                 ///< about the start of what came
};

/// The accuracy set anew, after the world's own and in this order of settings and numbers.
Result<ModelEdit> with_accuracy(const Model& model, const AccuracySpec& spec);

/// What a model of `addition` is called where that is added under `name`; empty: as it is called there.
std::string name_in_model(const Model& addition, const std::string& old, const std::string& name);

/// All that `addition` holds, robots and scenery, put at X_WA. `name`: of its only model, instead of its own;
/// empty: its own. Refuses names that are taken and another step.
Result<ModelEdit> with_models(const Model& model, const Model& addition, const Pose& X_WA,
                              const std::string& name);
/// The same once for each place: one edit, however many copies. Refuses all of them if a name is taken or two
/// copies have the same. Error codes: name-taken, other-step, no-model.
Result<ModelEdit> with_models(const Model& model, const Model& addition, std::span<const CopyPlace> places,
                              Standing standing = Standing::kAsPlaced);

/// A robot of some Model that is to come to another one, or to its own once more.
struct RobotFrom {
    std::shared_ptr<const Model> model;  ///< that it is of; it may be the Model that it comes to
    RobotId robot;                       ///< of that Model
    std::string name;                    ///< that it gets
    Pose X_WR;                           ///< m, of its robot (SDF model) frame in the world
    std::vector<double> start_q{};       ///< its joint coordinates at the start; empty: those of its type
    /// It was in this world before, with this name: it is of the family of its former companions, and its
    /// scenery, which stayed, is its own again.
    bool returns = false;
};

/// These robots added behind the others, all of them or none, at rest. Models of one run only: all have the
/// same step and fluids. Error codes: name-taken.
Result<ModelEdit> with_robots(const Model& model, std::span<const RobotFrom> robots);

/// Without these robots, each a name or a pattern (find_robots()). Types, hulls and surfaces that only they
/// had go with them; their scenery, if any, stays.
Result<ModelEdit> without_robots(const Model& model, const std::vector<std::string>& names);

/// States by the new RobotIds; of those that came: their initial state. Contacts with robots that are gone
/// are forgotten, and who slept against one wakes.
std::vector<RobotState> carry_over(const ModelEdit& edit, const std::vector<RobotState>& states);

/// Whether the order is for a robot that stays; then it is renumbered.
bool carry_over(const ModelEdit& edit, Order& order);

}  // namespace roboss
