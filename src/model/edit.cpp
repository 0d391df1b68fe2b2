// Models made of Models.
#include "model/edit.h"

#include <algorithm>
#include <set>

#include "model/accuracy.h"
#include "model/seal.h"

namespace roboss {

namespace {

std::vector<RobotId> all_stay(const Model& model) {
    std::vector<RobotId> now;
    for (std::size_t i = 0; i < model.robots.size(); ++i) now.emplace_back(i);
    return now;
}

ModelEdit sealed(std::shared_ptr<Model> model, std::vector<RobotId> now, bool scenery_changed) {
    seal(*model);
    return {std::move(model), std::move(now), scenery_changed};
}

/// The place of this type in the Model, where it is put if no equal one is there.
TypeId place_of_type(Model& model, const RobotType& type) {
    for (std::size_t i = 0; i < model.types.size(); ++i)
        if (model.types[i].hash == type.hash && model.types[i].name == type.name) return TypeId(i);
    model.types.push_back(type);
    return TypeId(model.types.size() - 1);
}

Error taken(const std::string& name) {
    return {"there is a robot '" + name + "' already", "give another name with --name"};
}

}  // namespace

std::string name_in_model(const Model& addition, const std::string& old, const std::string& name) {
    if (name.empty()) return old;
    return addition.robots.size() == 1 && addition.robots.front().name == old ? name : name + "::" + old;
}

Result<ModelEdit> with_accuracy(const Model& model, const AccuracySpec& spec) {
    auto changed = std::make_shared<Model>(model);
    Diagnostics found;
    apply(spec, changed->accuracy, found);
    if (found.has_errors()) return Error{found.items().front().message, found.items().front().remedy};
    return sealed(std::move(changed), all_stay(model), false);
}

Result<ModelEdit> with_models(const Model& model, const Model& addition, const Pose& X_WA,
                              const std::string& name) {
    if (addition.dt_s != model.dt_s)
        return Error{"the addition was compiled for a step of " + std::to_string(addition.dt_s) +
                         " s, the world has " + std::to_string(model.dt_s) + " s",
                     "compile it with the world's step"};
    if (addition.robots.empty() && addition.statics.empty())
        return Error{"there is no model in the file", "give a file with at least one model"};
    auto changed = std::make_shared<Model>(model);
    std::uint32_t family = 0;
    for (const Robot& robot : model.robots) family = std::max(family, robot.family + 1);
    const std::size_t first = model.robots.size();
    for (const Robot& robot : addition.robots) {
        Robot added = robot;
        added.name = name_in_model(addition, robot.name, name);
        if (model.find_robot(added.name)) return taken(added.name);
        added.type = place_of_type(*changed, addition.types[robot.type.index()]);
        added.X_WR = X_WA * robot.X_WR;
        added.X_WR.q = normalized(added.X_WR.q);
        added.family += family;
        changed->robots.push_back(std::move(added));
    }
    const Transform X_W = to_transform(X_WA);
    for (StaticShape shape : addition.statics) {
        shape.X_WS = X_W * shape.X_WS;
        shape.name = name.empty() ? shape.name : name + "::" + shape.name;
        if (shape.robot.valid()) shape.robot = RobotId(first + shape.robot.index());
        changed->statics.push_back(std::move(shape));
    }
    changed->hulls.insert(changed->hulls.end(), addition.hulls.begin(), addition.hulls.end());
    changed->surfaces.insert(changed->surfaces.end(), addition.surfaces.begin(), addition.surfaces.end());
    return sealed(std::move(changed), all_stay(model), !addition.statics.empty());
}

Result<ModelEdit> without_robots(const Model& model, const std::vector<std::string>& names) {
    std::set<std::uint32_t> gone;
    for (const std::string& name : names) {
        const std::optional<RobotId> robot = model.find_robot(name);
        if (!robot)
            return Error{"there is no robot '" + name + "' in the world",
                         "see `roboss control status` for their names"};
        gone.insert(robot->value);
    }
    auto changed = std::make_shared<Model>(model);
    changed->robots.clear();
    std::vector<RobotId> now(model.robots.size());
    for (std::uint32_t i = 0; i < model.robots.size(); ++i) {
        if (gone.contains(i)) continue;
        now[i] = RobotId(changed->robots.size());
        changed->robots.push_back(model.robots[i]);
    }
    for (StaticShape& shape : changed->statics) {
        if (shape.robot.valid()) shape.robot = now[shape.robot.index()];
        if (!shape.robot.valid()) shape.link = LinkId();
    }
    return sealed(std::move(changed), std::move(now), false);
}

std::vector<RobotState> carry_over(const ModelEdit& edit, const std::vector<RobotState>& states) {
    std::vector<RobotState> carried;
    for (std::size_t i = 0; i < edit.model->robots.size(); ++i)
        carried.push_back(initial_state(*edit.model, RobotId(i)));
    const auto is_gone = [&](std::uint32_t robot) { return !edit.now[robot].valid(); };
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!edit.now[i].valid()) continue;
        RobotState& state = carried[edit.now[i].index()];
        state = states[i];
        std::erase_if(state.contacts, [&](const ContactMemory& c) {
            return c.other_robot != RobotId::kNone && is_gone(c.other_robot);
        });
        for (ContactMemory& c : state.contacts)
            if (c.other_robot != RobotId::kNone) c.other_robot = edit.now[c.other_robot].value;
        auto& neighbours = state.rest.neighbours;
        if (edit.scenery_changed || std::any_of(neighbours.begin(), neighbours.end(), is_gone))
            state.rest = {};
        for (std::uint32_t& neighbour : state.rest.neighbours) neighbour = edit.now[neighbour].value;
    }
    return carried;
}

bool carry_over(const ModelEdit& edit, Order& order) {
    order.robot = edit.now[order.robot.index()];
    return order.robot.valid();
}

}  // namespace roboss
