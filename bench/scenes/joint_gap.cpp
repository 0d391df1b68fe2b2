// See joint_gap.h.
#include "scenes/joint_gap.h"

#include <algorithm>
#include <map>
#include <string>

namespace roboss::bench {

double widest_joint_gap(const World& world, const Engine& engine) {
    double widest = 0;
    for (std::size_t i = 0; i < world.instances.size(); ++i) {
        const ModelSpec& model = world.prototypes[world.instances[i].prototype];
        std::map<std::string, std::size_t> links;
        for (std::size_t l = 0; l < model.links.size(); ++l) links[model.links[l].name] = l;
        const auto place = [&](const std::string& link, const Vec3& p_MJ) {
            const auto found = links.find(link);
            if (found == links.end()) return world.instances[i].X_WM * p_MJ;  // the world
            const Pose& X_ML = model.links[found->second].X_ML;
            return engine.link({i, found->second}).X_WL * (inverse(X_ML) * p_MJ);
        };
        for (const JointSpec& joint : model.joints)
            widest =
                std::max(widest, norm(place(joint.parent, joint.X_MJ.p) - place(joint.child, joint.X_MJ.p)));
    }
    return widest;
}

}  // namespace roboss::bench
