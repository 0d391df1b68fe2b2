// See apply_link_wrench.h.
#include "onboard_kinds/apply_link_wrench.h"

#include <algorithm>

namespace roboss {
namespace {

/// The link that the entity is, for the model `model`: "" is the canonical one; false: it is another model's.
bool link_of(const PersistentWrench& wrench, const std::string& model, std::string& link) {
    link.clear();
    if (wrench.entity_name == model) return true;
    if (!wrench.entity_name.starts_with(model + "::")) return false;
    link = wrench.entity_name.substr(model.size() + 2);
    return true;
}

}  // namespace

std::vector<ApplyLinkWrenchSpec> ApplyLinkWrenchSpec::for_model(const std::string& world,
                                                                const std::string& model) const {
    const std::string usual = "/world/" + world + "/wrench";
    ApplyLinkWrenchSpec one;
    one.topic = topic.empty() ? usual : topic;
    one.topic_persistent = topic_persistent.empty() ? usual + "/persistent" : topic_persistent;
    one.topic_clear = topic_clear.empty() ? usual + "/clear" : topic_clear;
    std::vector<ApplyLinkWrenchSpec> found{one};
    for (const PersistentWrench& wrench : persistent) {
        std::string name;
        if (!link_of(wrench, model, name)) continue;
        auto same = std::ranges::find_if(found, [&](const ApplyLinkWrenchSpec& spec) {
            return name.empty() ? spec.link.empty() : !spec.link.empty() && spec.link.front() == name;
        });
        if (same == found.end()) {
            found.push_back(one);
            same = found.end() - 1;
            same->link.push_back(name);
        }
        same->persistent.push_back(wrench);
    }
    return found;
}

std::vector<Channel> ApplyLinkWrenchSpec::channels() const {
    const std::vector<ChannelValue> wrench{{"force_x", "N"},    {"force_y", "N"},    {"force_z", "N"},
                                           {"torque_x", "N m"}, {"torque_y", "N m"}, {"torque_z", "N m"},
                                           {"offset_x", "m"},   {"offset_y", "m"},   {"offset_z", "m"}};
    const std::string name = link.empty() ? "wrench" : "link/" + link.front() + "/wrench";
    return {{name, topic, wrench},
            {name + "/persistent", topic_persistent, wrench},
            {name + "/clear", topic_clear, {{"clear", ""}}}};
}

void ApplyLinkWrenchSpec::check(std::vector<OnboardProblem>& problems) const {
    for (const PersistentWrench& wrench : persistent) {
        if (wrench.entity_name.empty())
            problems.push_back({"has a <persistent> without <entity_name>", "Name a model or a link."});
        if (wrench.entity_type != "model" && wrench.entity_type != "link")
            problems.push_back({"has an <entity_type> '" + wrench.entity_type + "'", "Write model or link."});
    }
}

}  // namespace roboss
