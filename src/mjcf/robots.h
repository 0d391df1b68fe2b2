// Robots: the models that the bodies of an MJCF file make. Each tree of bodies below <worldbody> that can
// move is one robot, named by its root body (decision 0028); trees that an equality ties together are one
// robot, too. Bodies that cannot move are scenery.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mjcf/tree.h"
#include "world/world.h"

namespace roboss::mjcf {

/// What a tree of bodies becomes.
enum class Fate {
    kScenery,  ///< it never moves
    kMocap,    ///< it goes where it is told
    kFixed,    ///< a robot whose base is fixed, or jointed to the world
    kFree      ///< a robot with a free base
};

class Robots {
  public:
    /// `tied`: pairs of bodies of two fixed robots that an equality connects.
    Robots(Tree& tree, const std::vector<std::pair<std::size_t, std::size_t>>& tied, const Reading& reading);

    /// Root body of the tree that holds a body; 0: the world itself.
    std::size_t root_of(std::size_t body) const { return roots_[body]; }
    Fate fate_of(std::size_t body) const { return fates_[roots_[body]]; }
    /// The model of a body, in World::prototypes.
    ModelSpec& model_of(std::size_t body) { return models_[model_of_[body]]; }
    bool same_model(std::size_t a, std::size_t b) const { return model_of_[a] == model_of_[b]; }
    /// The link of a body.
    LinkSpec& link_of(std::size_t body);
    /// The joint of the model that a joint of the file became; nullptr: a free joint.
    JointSpec* joint_of(const Tree::JointPlace& place);
    /// Name of a body in its model, and of a part of a body (joint, site). Those of copies of a robot
    /// (<replicate>, <attach>) are alike: the robots' own names differ, and all are of one type.
    std::string local_name(std::size_t body) const;
    std::string local_name(std::size_t body, const std::string& part) const;
    /// Pose of a body in its model, all joints at zero.
    const Pose& pose_of(std::size_t body) const { return X_MB_[body]; }
    /// Pose of a body's model in the world.
    const Pose& place_of(std::size_t body) const { return starts_[model_of_[body]].X_WM; }
    /// How a body's model starts; its name and prototype are set by move_to().
    ModelInstance& start_of(std::size_t body) { return starts_[model_of_[body]]; }
    const Tree& tree() const { return tree_; }

    /// Hands the models over.
    void move_to(World& world);

    static std::vector<std::size_t> roots_in(const Tree& tree);
    static std::vector<Fate> fates_in(const Tree& tree, const std::vector<std::size_t>& roots);

  private:
    std::size_t start_model(std::size_t body);
    void add_body(std::size_t body);
    std::string add_joints(const BodyPart& body, const std::string& parent, Pose& X);
    void add_link(std::size_t body, const Pose& X);

    Tree& tree_;
    std::vector<std::size_t> roots_;
    std::vector<Fate> fates_;  // by root
    std::vector<Names> copy_;  // by root: what its names lose; empty where trees are tied to each other
    double mass_factor_ = 1;
    std::vector<Pose> X_MB_;
    std::vector<std::size_t> model_of_, link_index_;
    std::vector<std::vector<std::size_t>> joint_index_;  // by body, by joint
    std::vector<ModelSpec> models_;
    std::vector<ModelInstance> starts_;  // by model
};

}  // namespace roboss::mjcf
