// ApplyLinkWrench of Gazebo, a plugin of the world: pushes links for one tick or until it is told to stop.
#pragma once

#include <string>
#include <vector>

#include "math/vec3.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// A wrench that acts from the start: force and torque at the link's origin, world axes.
struct PersistentWrench {
    std::string entity_name,    ///< "model" or "model::link"
        entity_type = "model";  ///< model: its canonical link; link
    Vec3 force,                 ///< N
        torque;                 ///< N m

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"entity_name", "entity_name"}, s.entity_name);
        visit({"entity_type", "entity_type"}, s.entity_type);
        visit({"force", "force", "N"}, s.force);
        visit({"torque", "torque", "N m"}, s.torque);
    }
    /// Compares all members.
    friend bool operator==(const PersistentWrench&, const PersistentWrench&) = default;
};

/// The plugin acts on all models of its world. Each model gets a controller for its canonical link, and one
/// for each other link that a `<persistent>` names (for_model).
struct ApplyLinkWrenchSpec {
    std::vector<PersistentWrench> persistent;  ///< from the start; of a model's controller: on its link
    LinkNames link;                            ///< one: that it pushes; none: the canonical link
    std::string topic,                         ///< of a wrench of one tick; empty: /world/WORLD/wrench
        topic_persistent,                      ///< of one that stays; empty: /world/WORLD/wrench/persistent
        topic_clear;  ///< that ends those that stay; empty: /world/WORLD/wrench/clear

    /// Elements of Gazebo's without effect.
    static constexpr IgnoredElement kIgnored[] = {{"verbose", "0|1|true|false", "it only prints"}};
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 32,
                                       .name = "apply-link-wrench",
                                       .phrase = "an apply-link-wrench plugin",
                                       .classes = "ApplyLinkWrench",
                                       .files = "apply-link-wrench-system",
                                       .ignored = kIgnored};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"persistent", "persistent"}, s.persistent);
        visit({"link", "roboss:link"}, s.link);
        visit({"topic", "topic"}, s.topic);
        visit({"topic_persistent", "topic_persistent"}, s.topic_persistent);
        visit({"topic_clear", "topic_clear"}, s.topic_clear);
    }
    /// The controllers that a plugin of the world `world` means for the model `model`.
    std::vector<ApplyLinkWrenchSpec> for_model(const std::string& world, const std::string& model) const;
    /// The commands that it takes: force and torque in world axes, at `offset` from the link's origin, link
    /// axes.
    std::vector<Channel> channels() const;
    /// Its memory at the start: the tick of the last wrench of one tick that it applied.
    std::vector<double> memory() const { return {-1}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const ApplyLinkWrenchSpec&, const ApplyLinkWrenchSpec&) = default;
};

}  // namespace roboss
