// Models made of Models.
#include "model/edit.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "model/accuracy.h"
#include "model/compile_type.h"
#include "model/on_ground.h"
#include "model/robot_names.h"
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
    return {std::move(model), std::move(now), scenery_changed, {}};
}

/// The place of this type in the Model, where it is put if no equal one is there.
TypeId place_of_type(Model& model, const RobotType& type) {
    for (std::size_t i = 0; i < model.types.size(); ++i)
        if (model.types[i].hash == type.hash && model.types[i].name == type.name &&
            ros_names(model.types[i]) == ros_names(type))
            return TypeId(i);
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

Error taken(const std::string& name, bool by_copy) {
    return {by_copy ? "two of the added robots are called '" + name + "'"
                    : "there is a robot '" + name + "' already",
            "give another name with --name, or each copy one of its own", "name-taken"};
}

void move(StaticShape& shape, const Transform& X) {
    shape.X_WS = X * shape.X_WS;
    for (Vec3* v : {&shape.flow.linear, &shape.flow.angular, &shape.flow.belt}) *v = X.R * *v;
    shape.flow.at = X * shape.flow.at;
}

/// A Model that copies of another one are added to. Robots and scenery first, then seal().
class Extension {
  public:
    Extension(const Model& model, const Model& addition, std::size_t copies)
        : addition_(addition), model_(std::make_shared<Model>(model)), types_(addition.types.size()) {
        for (const Robot& robot : model.robots) family_ = std::max(family_, robot.family + 1);
        model_->robots.reserve(model.robots.size() + copies * addition.robots.size());  // names_ look into it
        for (const Robot& robot : model_->robots) names_.insert(robot.name);
        old_robots_ = model.robots.size();
    }

    /// An Error: a name is taken.
    Result<> add(const CopyPlace& place) {
        const std::size_t first = model_->robots.size();
        std::uint32_t next_family = family_;
        for (const Robot& robot : addition_.robots) {
            model_->robots.push_back(copy_of(robot, place));
            next_family = std::max(next_family, model_->robots.back().family + 1);
            const std::string& name = model_->robots.back().name;
            if (!names_.insert(name).second) return taken(name, is_new(name));
        }
        family_ = next_family;
        const Transform X_W = to_transform(place.X_WA);
        for (StaticShape shape : addition_.statics) {
            move(shape, X_W);
            shape.name = place.name.empty() ? shape.name : place.name + "::" + shape.name;
            if (shape.robot.valid()) shape.robot = RobotId(first + shape.robot.index());
            model_->statics.push_back(std::move(shape));
        }
        return Ok{};
    }

    ModelEdit finish(Standing standing) {
        Model& model = *model_;
        Diagnostics found;
        if (standing == Standing::kOnGround) report(stand_on_ground(model, old_robots_), {}, found);
        model.hulls.insert(model.hulls.end(), addition_.hulls.begin(), addition_.hulls.end());
        model.surfaces.insert(model.surfaces.end(), addition_.surfaces.begin(), addition_.surfaces.end());
        remove_unused_shapes(model);
        std::vector<RobotId> now;
        for (std::size_t i = 0; i < old_robots_; ++i) now.emplace_back(i);
        ModelEdit edit = sealed(std::move(model_), std::move(now), !addition_.statics.empty());
        edit.found = std::move(found);
        return edit;
    }

  private:
    Robot copy_of(const Robot& robot, const CopyPlace& place) {
        Robot copy = robot;
        copy.name = name_in_model(addition_, robot.name, place.name);
        copy.type = type_of(robot.type);
        copy.X_WR = place.X_WA * robot.X_WR;
        copy.X_WR.q = normalized(copy.X_WR.q);
        copy.family += family_;
        turn_velocity(place.X_WA.q, copy);
        return copy;
    }

    /// The velocity of a free base is in world axes.
    void turn_velocity(const Quat& q, Robot& robot) const {
        std::vector<double>& v = robot.start_v;
        if (v.empty() || !model_->types[robot.type.index()].free_base) return;
        for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) {
            const Vec3 turned = rotate(q, Vec3{v[i], v[i + 1], v[i + 2]});
            v[i] = turned.x, v[i + 1] = turned.y, v[i + 2] = turned.z;
        }
    }

    TypeId type_of(TypeId type) {
        TypeId& known = types_[type.index()];
        if (!known.valid()) known = place_of_type(*model_, afloat(*model_, addition_.types[type.index()]));
        return known;
    }

    /// An added robot has this name already.
    bool is_new(const std::string& name) const {
        const auto added = model_->robots.begin() + static_cast<std::ptrdiff_t>(old_robots_);
        return std::any_of(added, model_->robots.end() - 1, [&](const Robot& r) { return r.name == name; });
    }

    const Model& addition_;
    std::shared_ptr<Model> model_;
    std::vector<TypeId> types_;  // by the addition's: in the new Model
    std::uint32_t family_ = 0;   // the first of the next copy
    std::size_t old_robots_ = 0;
    std::unordered_set<std::string_view> names_;
};

/// A Model that single robots come to, from Models of the same run.
class Arrival {
  public:
    explicit Arrival(const Model& model)
        : model_(std::make_shared<Model>(model)), old_robots_(model.robots.size()) {
        for (const Robot& robot : model.robots) {
            names_.insert(robot.name);
            next_family_ = std::max(next_family_, robot.family + 1);
        }
    }

    /// An Error: the name is taken.
    Result<> add(const RobotFrom& from) {
        if (!names_.insert(from.name).second)
            return taken(from.name, !model_->find_robot(from.name) ||
                                        model_->find_robot(from.name)->index() >= old_robots_);
        const Robot& old = from.model->robots[from.robot.index()];
        Robot robot = old;
        robot.name = from.name;
        robot.type = place_of_type(*model_, from.model->types[old.type.index()]);
        robot.X_WR = from.X_WR;
        robot.X_WR.q = normalized(robot.X_WR.q);
        robot.family = family_of(from, old.family);
        robot.start_q = from.start_q;
        robot.start_v.clear();
        if (sources_.insert(from.model).second) take_shapes(*from.model);
        const RobotId id(model_->robots.size());
        model_->robots.push_back(std::move(robot));
        add_scenery(from, old, id);
        return Ok{};
    }

    ModelEdit finish() {
        remove_unused_shapes(*model_);
        std::vector<RobotId> now;
        for (std::size_t i = 0; i < old_robots_; ++i) now.emplace_back(i);
        return sealed(std::move(model_), std::move(now), scenery_changed_);
    }

  private:
    void take_shapes(const Model& from) {
        model_->hulls.insert(model_->hulls.end(), from.hulls.begin(), from.hulls.end());
        model_->surfaces.insert(model_->surfaces.end(), from.surfaces.begin(), from.surfaces.end());
    }

    /// Of those that come together one family stays one; a robot that returns finds its companions.
    std::uint32_t family_of(const RobotFrom& from, std::uint32_t old) {
        std::uint32_t& family = families_.try_emplace({from.model.get(), old}, next_family_).first->second;
        if (family < next_family_) return family;
        ++next_family_;
        if (!from.returns) return family;
        for (const Robot& companion : from.model->robots) {
            if (companion.family != old) continue;
            const std::optional<RobotId> now = model_->find_robot(companion.name);
            if (now && now->index() < old_robots_ && model_->robots[now->index()].family == old)
                return family = old;
        }
        return family;
    }

    void add_scenery(const RobotFrom& from, const Robot& old, RobotId id) {
        const Transform X = to_transform(model_->robots[id.index()].X_WR) * inverse(to_transform(old.X_WR));
        for (StaticShape shape : from.model->statics) {
            if (shape.robot != from.robot) continue;
            shape.robot = id;
            if (from.returns && take_back(shape)) continue;
            move(shape, X);
            const bool by_name = shape.name.starts_with(old.name + "::");
            shape.name = from.name + "::" + (by_name ? shape.name.substr(old.name.size() + 2) : shape.name);
            model_->statics.push_back(std::move(shape));
            scenery_changed_ = true;
        }
    }

    /// Scenery of a robot stays when the robot is removed.
    bool take_back(const StaticShape& shape) {
        for (StaticShape& left : model_->statics) {
            if (left.robot.valid() || left.name != shape.name) continue;
            left.robot = shape.robot, left.link = shape.link, left.driven = shape.driven;
            return true;
        }
        return false;
    }

    std::shared_ptr<Model> model_;
    std::size_t old_robots_ = 0;
    std::uint32_t next_family_ = 0;
    bool scenery_changed_ = false;
    std::unordered_set<std::string> names_;
    std::map<std::pair<const Model*, std::uint32_t>, std::uint32_t> families_;
    std::unordered_set<std::shared_ptr<const Model>> sources_;  // whose shapes have been taken
};

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
    const CopyPlace place{name, X_WA};
    return with_models(model, addition, {&place, 1});
}

Result<ModelEdit> with_models(const Model& model, const Model& addition, std::span<const CopyPlace> places,
                              Standing standing) {
    if (addition.dt_s != model.dt_s)
        return Error{"the addition was compiled for a step of " + std::to_string(addition.dt_s) +
                         " s, the world has " + std::to_string(model.dt_s) + " s",
                     "compile it with the world's step", "other-step"};
    if (addition.robots.empty() && addition.statics.empty())
        return Error{"there is no model in the file", "give a file with at least one model", "no-model"};
    Extension extension(model, addition, places.size());
    for (const CopyPlace& place : places)
        if (Result<> added = extension.add(place); !added) return added.error();
    return extension.finish(standing);
}

Result<ModelEdit> with_robots(const Model& model, std::span<const RobotFrom> robots) {
    Arrival arrival(model);
    for (const RobotFrom& from : robots)
        if (Result<> added = arrival.add(from); !added) return added.error();
    return arrival.finish();
}

Result<ModelEdit> without_robots(const Model& model, const std::vector<std::string>& names) {
    std::unordered_map<std::string_view, std::uint32_t> by_name;
    for (std::uint32_t i = 0; i < model.robots.size(); ++i) by_name.emplace(model.robots[i].name, i);
    std::set<std::uint32_t> gone;
    for (const std::string& name : names) {
        if (const auto found = by_name.find(name); found != by_name.end()) {
            gone.insert(found->second);
            continue;
        }
        const std::vector<RobotId> robots = find_robots(model, name);
        if (robots.empty()) return no_such_robot(model, name);
        for (const RobotId robot : robots) gone.insert(robot.value);
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
    std::vector<RobotState> carried(edit.model->robots.size());
    std::vector<char> stays(carried.size(), 0);
    for (const RobotId& now : edit.now)
        if (now.valid()) stays[now.index()] = 1;
    for (std::size_t i = 0; i < carried.size(); ++i)
        if (!stays[i]) carried[i] = initial_state(*edit.model, RobotId(i));
    const auto is_gone = [&](std::uint32_t robot) { return !edit.now[robot].valid(); };
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!edit.now[i].valid()) continue;
        RobotState& state = carried[edit.now[i].index()];
        state = states[i];
        state.own_type = OwnType(edit.model->type_of(edit.now[i]), state.own);
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
        // a message to a removed robot gets its sender as addressee: no radio receives it
        for (RadioState& radio : state.radios)
            for (Transmission& t : radio.sent)
                if (t.to != RobotId::kNone) t.to = edit.now[is_gone(t.to) ? i : t.to].value;
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
    if (auto* message = std::get_if<Transmit>(&order.action);
        message != nullptr && message->to.valid() && !stays(message->to))
        return false;
    return order.robot.valid();
}

}  // namespace roboss
