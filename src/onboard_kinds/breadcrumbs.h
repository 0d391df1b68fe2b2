// Breadcrumbs of Gazebo: a robot drops copies of a model on command. The importer adds the copies to the
// world, stored out of the way, since a step cannot add robots. The robot counts the commands, a control
// program (client/triggers/board_watch.h) puts the next copy in place for each.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// On the robot that drops the crumbs.
struct BreadcrumbsSpec {
    std::string topic;         ///< of the command; empty: /model/NAME/breadcrumbs/CRUMB/deploy
    std::string crumb;         ///< name of the model that is copied
    int max_deployments = -1;  ///< copies at most; negative: no limit, here kUnlimited
    double disable_physics_time =
        0;                        ///< s: so long after it was dropped a crumb is fixed where it is; 0: never
    bool allow_renaming = false;  ///< a crumb whose name is taken gets another one; else it is not dropped

    /// Copies that are made if there is no limit.
    static constexpr int kUnlimited = 50;

    static constexpr IgnoredElement kIgnored[] = {
        {"topic_statistics", "false|0", "no message is lost on its way to a robot"},
        {"performer_volume", "", "nothing is loaded by distance, so that crumbs need not be performers"},
    };
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 92,
                                       .name = "breadcrumbs",
                                       .phrase = "a supply of breadcrumbs",
                                       .classes = "Breadcrumbs",
                                       .files = "breadcrumbs-system",
                                       .ignored = kIgnored};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"topic", "topic"}, s.topic);
        visit({"crumb", ""}, s.crumb);
        visit({"max_deployments", "max_deployments"}, s.max_deployments);
        visit({"disable_physics_time", "disable_physics_time", "s"}, s.disable_physics_time);
        visit({"allow_renaming", "allow_renaming"}, s.allow_renaming);
    }
    /// The command that it takes: it has no values.
    std::vector<Channel> channels() const {
        return {channel_of(topic, "breadcrumbs/" + crumb + "/deploy", {})};
    }
    /// Its memory: tick of the last command that was counted, how many there were.
    enum Memory : std::size_t { kCounted, kCount };
    /// At the start.
    std::vector<double> memory() const { return {-1, 0}; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (crumb.empty())
            problems.push_back({"has no model to drop", "Write <breadcrumb><sdf><model>, with links."});
    }
    /// Compares all members.
    friend bool operator==(const BreadcrumbsSpec&, const BreadcrumbsSpec&) = default;
};

/// On each crumb: it is stored, asleep, until it is dropped.
struct CrumbSpec {
    double fixed_after =
        -1;  ///< s since it was dropped, from then on it is fixed where it is; negative: never

    /// What this kind states about itself. No plugin has its names.
    static constexpr OnboardKind kKind{
        .number = 93, .name = "crumb", .phrase = "a breadcrumb", .classes = "", .files = ""};
    static constexpr const char* kDropped = "dropped";  ///< its command: it is in use from now on

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"fixed_after", "", "s"}, s.fixed_after);
    }
    /// The command that it takes: it has no values.
    std::vector<Channel> channels() const { return {channel_of("", kDropped, {})}; }
    /// At the start: 1 once it is fixed.
    std::vector<double> memory() const { return {0}; }
    /// Whether it would change nothing while its robot is at rest.
    bool rests(std::span<const double> memory) const { return fixed_after < 0 || memory[0] != 0; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>&) const {}
    /// Compares all members.
    friend bool operator==(const CrumbSpec&, const CrumbSpec&) = default;
};

}  // namespace roboss
