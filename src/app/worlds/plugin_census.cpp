// See plugin_census.h.
#include "app/worlds/plugin_census.h"

#include <algorithm>

#include "model/topics.h"

namespace roboss {
namespace {

bool same_place(const SourceLocation& a, const SourceLocation& b) {
    return a.file == b.file && a.line == b.line;
}

/// The controllers of a model that no robot of it runs.
std::vector<const OnboardSpec*> left_out(const ModelSpec& spec, std::vector<const OnboardSpec*> running) {
    std::vector<const OnboardSpec*> missing;
    for (const OnboardSpec& wanted : spec.onboard) {
        const auto same = [&](const OnboardSpec* other) { return other->parameters == wanted.parameters; };
        if (const auto found = std::ranges::find_if(running, same); found != running.end())
            running.erase(found);
        else
            missing.push_back(&wanted);
    }
    return missing;
}

class PluginList {
  public:
    PluginList(const World& world, const Model* model, const Diagnostics& diagnostics)
        : world_(world), diagnostics_(diagnostics), running_(world.instances.size()) {
        if (model == nullptr) return;
        for (const Robot& robot : model->robots)
            for (const OnboardInfo& info : model->types[robot.type.index()].onboard)
                if (robot.family < running_.size()) running_[robot.family].push_back(&info.spec);
    }

    std::vector<PluginReport> list() && {
        for (const ExtensionElement& element : world_.extensions) add(element, {}, 1, {});
        for (std::size_t p = 0; p < world_.prototypes.size(); ++p) add_prototype(p);
        return std::move(reports_);
    }

  private:
    void add_prototype(std::size_t prototype) {
        const ModelSpec& spec = world_.prototypes[prototype];
        const auto of_it = [&](const ModelInstance& instance) { return instance.prototype == prototype; };
        const auto first = std::ranges::find_if(world_.instances, of_it);
        if (first == world_.instances.end()) return;
        const auto count = static_cast<std::size_t>(std::ranges::count_if(world_.instances, of_it));
        const auto index = static_cast<std::size_t>(first - world_.instances.begin());
        const std::vector<const OnboardSpec*> missing = left_out(spec, running_[index]);
        for (const ExtensionElement& element : spec.extensions) add(element, first->name, count, missing);
    }

    void add(const ExtensionElement& element, const std::string& model, std::size_t count,
             const std::vector<const OnboardSpec*>& missing) {
        if (element.name != "plugin") return;
        PluginReport report;
        report.model = model, report.parent = element.parent, report.owner = element.owner;
        report.name = element.plugin, report.where = element.where, report.count = count;
        report.fate = element.fate, report.reason = element.reason;
        const auto here = [&](const OnboardSpec* spec) { return same_place(spec->where, element.where); };
        if (report.fate == PluginFate::kRuns && std::ranges::any_of(missing, here)) {
            report.fate = PluginFate::kNotRun;
            report.reason = why_left_out(element.where);
        }
        reports_.push_back(std::move(report));
    }

    std::string why_left_out(const SourceLocation& where) const {
        for (const Diagnostic& d : diagnostics_.items())
            if (d.code == "plugin-not-run" && same_place(d.where, where)) return d.message;
        return "its model is left out";
    }

    const World& world_;
    const Diagnostics& diagnostics_;
    std::vector<std::vector<const OnboardSpec*>> running_;  // by instance
    std::vector<PluginReport> reports_;
};

}  // namespace

std::vector<TypeCommands> list_commands(const Model& model) {
    std::vector<TypeCommands> all(model.types.size());
    std::vector<std::size_t> firsts(model.types.size(), model.types.size());  // in `all`, by RobotType::like
    for (const Robot& robot : model.robots) {
        const std::size_t place = robot.type.index();
        std::size_t& first = firsts[model.types[place].like.index()];
        if (first == model.types.size()) first = place;
        all[first].alike += first != place ? 1 : 0;
        all[place].is_repeated = first != place;
        TypeCommands& type = all[robot.type.index()];
        if (type.robots++ > 0) continue;
        type.first = robot.name;
        type.is_board = board_of(model.types[robot.type.index()]) != nullptr;
        for (const ChannelInfo& info : model.types[robot.type.index()].channels)
            type.commands.push_back(info.channel);
    }
    std::erase_if(all, [](const TypeCommands& type) { return type.commands.empty(); });
    return all;
}

std::vector<PluginReport> list_plugins(const World& world, const Model* model,
                                       const Diagnostics& diagnostics) {
    return PluginList(world, model, diagnostics).list();
}

const char* to_text(PluginFate fate) {
    switch (fate) {
        case PluginFate::kRuns:
            return "runs";
        case PluginFate::kNotNeeded:
            return "not needed";
        case PluginFate::kNotRun:
            return "not run";
    }
    return "?";
}

}  // namespace roboss
