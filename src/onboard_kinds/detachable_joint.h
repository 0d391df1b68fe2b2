// DetachableJoint of Gazebo: a bond between a link of the robot and a link of another model, from the start
// until it is told to let go, and again when it is told to attach.
#pragma once

#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// The child is found by its name: a model of the world, a model nested in this one, or, as "__model__", this
/// one.
struct DetachableJointSpec {
    LinkNames parent_link;     ///< of this model, one
    std::string child_model,   ///< name, "outer::inner", or "__model__"
        child_link;            ///< of the child model
    std::string detach_topic,  ///< empty: `old_topic`
        old_topic,             ///< what detach_topic was called before; empty: the default topic
        attach_topic;          ///< empty: the default topic

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"output_topic", "", "Clients read the bonds of a robot from its state"},
        {"suppress_child_warning", "true|false|1|0", "RoBOSS does not warn of a child that comes later"},
    };
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 50,
                                       .name = "detachable-joint",
                                       .phrase = "a detachable joint",
                                       .classes = "DetachableJoint",
                                       .files = "detachable-joint-system",
                                       .ignored = kIgnored};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"parent_link", "parent_link"}, s.parent_link);
        visit({"child_model", "child_model"}, s.child_model);
        visit({"child_link", "child_link"}, s.child_link);
        visit({"detach_topic", "detach_topic"}, s.detach_topic);
        visit({"topic", "topic"}, s.old_topic);
        visit({"attach_topic", "attach_topic"}, s.attach_topic);
    }
    /// The commands that it takes: they have no values.
    std::vector<Channel> channels() const {
        return {channel_of(detach_topic.empty() ? old_topic : detach_topic, "detachable_joint/detach", {}),
                channel_of(attach_topic, "detachable_joint/attach", {})};
    }
    /// What it remembers.
    enum Memory : std::size_t {
        kPhase,     ///< one of the numbers below
        kDetached,  ///< tick of the last command to detach that it has obeyed, -1: none
        kAttached   ///< likewise to attach
    };
    /// The first number of its memory.
    static constexpr double kLoose = 0;     ///< it holds nothing
    static constexpr double kWanted = 1;    ///< it is to attach as soon as the child is there
    static constexpr double kAttaches = 2;  ///< the bond forms in this tick
    static constexpr double kHolds = 3;     ///< it holds the child
    /// At the start: it is to attach.
    std::vector<double> memory() const { return {kWanted, -1, -1}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (parent_link.size() != 1)
            problems.push_back({"names no <parent_link>", "Name a link of the model."});
        if (child_model.empty()) problems.push_back({"names no <child_model>", "Name a model."});
        if (child_link.empty())
            problems.push_back({"names no <child_link>", "Name a link of the child model."});
    }
    /// Compares all members.
    friend bool operator==(const DetachableJointSpec&, const DetachableJointSpec&) = default;
};

}  // namespace roboss
