// Models made of Models.
#include "model/edit.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "model/accuracy.h"
#include "model/compile_type.h"
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

/// A type that was compiled for another world, in the fluids of this one.
RobotType afloat(const Model& model, RobotType type) {
    if (model.fluid.densities.empty() || !model.fluid.everywhere || type.is_static) return type;
    float_all(type);
    lay_out_onboard(type);
    type.hash = type_hash(type);
    return type;
}

std::vector<char> types_in_use(const Model& model) {
    std::vector<char> used(model.types.size(), 0);
    for (const Robot& robot : model.robots) used[robot.type.index()] = 1;
    return used;
}

/// Removes the types that these robots had and nobody has any more. `used`: before the edit.
void remove_types(Model& model, const std::vector<char>& used) {
    const std::vector<char> still = types_in_use(model);
    std::vector<TypeId> now(model.types.size());
    std::vector<RobotType> types;
    for (std::size_t i = 0; i < model.types.size(); ++i) {
        if (used[i] && !still[i]) continue;
        now[i] = TypeId(types.size());
        types.push_back(std::move(model.types[i]));
    }
    model.types = std::move(types);
    for (Robot& robot : model.robots) robot.type = now[robot.type.index()];
}

/// Keeps the hulls and surfaces that shapes point to, each once.
void remove_unused_shapes(Model& model) {
    std::unordered_set<const void*> used;
    const auto use = [&](const Shape& shape) { used.insert({shape.hull, shape.surface}); };
    for (const RobotType& type : model.types)
        for (const BodyShape& shape : type.shapes) use(shape.shape);
    for (const StaticShape& shape : model.statics) use(shape.shape);
    const auto is_unused = [&](const auto& held) { return used.erase(held.get()) == 0; };
    std::erase_if(model.hulls, is_unused);
    std::erase_if(model.surfaces, is_unused);
}

/// The robots with this name; "x*": those whose names begin with x.
std::vector<std::uint32_t> find_robots(const Model& model,
                                       const std::unordered_map<std::string_view, std::uint32_t>& by_name,
                                       const std::string& name) {
    if (const auto found = by_name.find(name); found != by_name.end()) return {found->second};
    std::vector<std::uint32_t> found;
    if (!name.ends_with('*')) return found;
    const std::string_view start = std::string_view(name).substr(0, name.size() - 1);
    for (std::uint32_t i = 0; i < model.robots.size(); ++i)
        if (model.robots[i].name.starts_with(start)) found.push_back(i);
    return found;
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
    std::unordered_set<std::string_view> names;
    for (const Robot& robot : model.robots) names.insert(robot.name);
    for (const Robot& robot : addition.robots) {
        Robot added = robot;
        added.name = name_in_model(addition, robot.name, name);
        if (names.contains(added.name)) return taken(added.name);
        added.type = place_of_type(*changed, afloat(model, addition.types[robot.type.index()]));
        added.X_WR = X_WA * robot.X_WR;
        added.X_WR.q = normalized(added.X_WR.q);
        added.family += family;
        changed->robots.push_back(std::move(added));
    }
    const Transform X_W = to_transform(X_WA);
    for (StaticShape shape : addition.statics) {
        shape.X_WS = X_W * shape.X_WS;
        for (Vec3* v : {&shape.flow.linear, &shape.flow.angular, &shape.flow.belt}) *v = X_W.R * *v;
        shape.flow.at = X_W * shape.flow.at;
        shape.name = name.empty() ? shape.name : name + "::" + shape.name;
        if (shape.robot.valid()) shape.robot = RobotId(first + shape.robot.index());
        changed->statics.push_back(std::move(shape));
    }
    changed->hulls.insert(changed->hulls.end(), addition.hulls.begin(), addition.hulls.end());
    changed->surfaces.insert(changed->surfaces.end(), addition.surfaces.begin(), addition.surfaces.end());
    remove_unused_shapes(*changed);
    return sealed(std::move(changed), all_stay(model), !addition.statics.empty());
}

Result<ModelEdit> without_robots(const Model& model, const std::vector<std::string>& names) {
    std::unordered_map<std::string_view, std::uint32_t> by_name;
    for (std::uint32_t i = 0; i < model.robots.size(); ++i) by_name.emplace(model.robots[i].name, i);
    std::set<std::uint32_t> gone;
    for (const std::string& name : names) {
        const std::vector<std::uint32_t> robots = find_robots(model, by_name, name);
        if (robots.empty())
            return Error{"there is no robot '" + name + "' in the world",
                         "see `roboss control status` for their names"};
        gone.insert(robots.begin(), robots.end());
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
        if (!shape.robot.valid()) shape.link = LinkId(), shape.driven = false;
    }
    remove_types(*changed, types_in_use(model));
    remove_unused_shapes(*changed);
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
        std::erase_if(state.bonds, [&](const Bond& bond) {
            return bond.other == RobotId::kNone ? edit.scenery_changed : is_gone(bond.other);
        });
        for (Bond& bond : state.bonds)
            if (bond.other != RobotId::kNone) bond.other = edit.now[bond.other].value;
        auto& neighbours = state.rest.neighbours;
        if (edit.scenery_changed || std::any_of(neighbours.begin(), neighbours.end(), is_gone))
            state.rest = {};
        for (std::uint32_t& neighbour : state.rest.neighbours) neighbour = edit.now[neighbour].value;
    }
    return carried;
}

bool carry_over(const ModelEdit& edit, Order& order) {
    order.robot = edit.now[order.robot.index()];
    const auto stays = [&](RobotId& other) {
        if (other.valid()) other = edit.now[other.index()];
        return other.valid();
    };
    if (auto* attach = std::get_if<Attach>(&order.action); attach != nullptr && !stays(attach->other))
        return false;
    if (auto* detach = std::get_if<Detach>(&order.action);
        detach != nullptr && detach->other.valid() && !stays(detach->other))
        return false;
    return order.robot.valid();
}

}  // namespace roboss
