// A Model that is not known (of a journal from before this run) looks like the world file.
#include "app/viewer/model_visuals.h"

#include <algorithm>
#include <unordered_set>

#include "scene/placed_copies.h"

namespace roboss {
namespace {

/// Names of the robots, and what stands before a "::" in them: a robot of several of a model is MODEL::LINK.
std::unordered_set<std::string_view> names_of(const Model& model) {
    std::unordered_set<std::string_view> names;
    for (const Robot& robot : model.robots) {
        const std::string_view name = robot.name;
        for (std::size_t end = name.size(); end != std::string_view::npos && end > 0;
             end = name.rfind("::", end - 1))
            names.insert(name.substr(0, end));
    }
    return names;
}

/// Whether anything of this World can still be seen; scenery stays for good.
bool is_seen(const World& world, const std::unordered_set<std::string_view>& names) {
    return std::any_of(world.instances.begin(), world.instances.end(), [&](const ModelInstance& instance) {
        return world.prototypes[instance.prototype].is_static || names.contains(instance.name);
    });
}

/// What the last of these Worlds that knows it says of the robot; a robot of several is called MODEL::LINK.
const ModelSpec* spec_of(std::span<const std::shared_ptr<const World>> worlds, const std::string& robot) {
    for (std::size_t end = robot.size(); end != std::string::npos && end > 0;
         end = robot.rfind("::", end - 1))
        for (auto world = worlds.rbegin(); world != worlds.rend(); ++world)
            for (const ModelInstance& instance : (*world)->instances)
                if (instance.name == robot.substr(0, end)) return &(*world)->prototypes[instance.prototype];
    return nullptr;
}

}  // namespace

void ModelVisuals::begin(const Model& model, World world) {
    first_ = {std::make_shared<const World>(std::move(world))};
    first_hash_ = model.hash;
}

void ModelVisuals::change(const Model& from, const Model& to) {
    if (to.hash == first_hash_ || by_model_.contains(to.hash)) return;
    Worlds worlds = worlds_of(from);
    if (worlds.empty()) return;
    if (to.robots.size() < from.robots.size()) {
        const auto names = names_of(to);
        std::erase_if(worlds, [&](const auto& world) {
            return (first_.empty() || world != first_.front()) && !is_seen(*world, names);
        });
    }
    learn(to, std::move(worlds));
}

void ModelVisuals::add(const Addition& addition, World world, std::span<const CopyPlace> places) {
    Worlds worlds = worlds_of(addition.from);
    worlds.push_back(std::make_shared<const World>(placed_copies(std::move(world), addition.added, places)));
    learn(addition.to, std::move(worlds));
}

void ModelVisuals::copy(const Model& from, const Model& to, std::span<const CopyRobots::Copy> copies) {
    Worlds worlds = worlds_of(from);
    World added;
    for (const CopyRobots::Copy& copy : copies)
        if (const ModelSpec* spec = spec_of(worlds, copy.robot)) {
            added.instances.push_back({copy.name, added.prototypes.size(), copy.X_WR, {}});
            added.prototypes.push_back(*spec);
        }
    worlds.push_back(std::make_shared<const World>(std::move(added)));
    learn(to, std::move(worlds));
}

void ModelVisuals::bring_back(const Model& from, const Model& to, const Worlds& worlds) {
    Worlds all = by_model_.contains(to.hash) ? worlds_of(to) : worlds_of(from);
    for (const auto& world : worlds)
        if (std::ranges::find(all, world) == all.end()) all.push_back(world);
    learn(to, std::move(all));
}

void ModelVisuals::keep_only(const Model& model) {
    std::erase_if(by_model_, [&](const auto& known) { return known.first != model.hash; });
    std::erase_if(order_, [&](std::uint64_t hash) { return hash != model.hash; });
}

void ModelVisuals::learn(const Model& model, Worlds worlds) {
    if (model.hash == first_hash_ && !first_.empty()) return;
    if (by_model_.insert_or_assign(model.hash, std::move(worlds)).second) order_.push_back(model.hash);
    if (order_.size() <= kModelsMost) return;
    by_model_.erase(order_.front());
    order_.pop_front();
}

ModelVisuals::Worlds ModelVisuals::worlds_of(const Model& model) const {
    const auto known = by_model_.find(model.hash);
    return known != by_model_.end() ? known->second : first_;
}

std::vector<const World*> ModelVisuals::of(const Model& model) const {
    std::vector<const World*> worlds;
    for (const auto& world : worlds_of(model)) worlds.push_back(world.get());
    return worlds;
}

}  // namespace roboss
