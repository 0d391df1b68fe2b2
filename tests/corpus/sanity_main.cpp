// Runs a world that nobody commands and says, as JSON, whether it is sane (sanity.h): what tools/check_corpus
// runs on each file. Usage: roboss_sanity FILE [--ground] [--on-ground] [--seconds S]
// Exit codes: 0 sane, 1 insane, 2 wrong usage, 3 the world is refused.
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "corpus/sanity.h"
#include "model/on_ground.h"
#include "sdf/load_world.h"
#include "world/bare_model.h"

namespace {

struct Options {
    std::string file;
    bool ground = false, on_ground = false;
    double seconds = 2;
};

bool parse(int argc, char** argv, Options& o) {
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--ground") {
            o.ground = true;
        } else if (word == "--on-ground") {
            o.on_ground = true;
        } else if (word == "--seconds" && i + 1 < argc) {
            o.seconds = std::atof(argv[++i]);
        } else if (o.file.empty() && word.front() != '-') {
            o.file = word;
        } else {
            return false;
        }
    }
    return !o.file.empty() && o.seconds > 0;
}

nlohmann::json to_json(const roboss::corpus::Figures& f) {
    return {
        {"robot", f.robot},   {"gain", f.gain},   {"explained", f.explained},         {"time_s", f.time_s},
        {"speed", f.speed},   {"depth", f.depth}, {"sleeper_moves", f.sleeper_moves}, {"driven", f.driven},
        {"sane", f.is_sane()}};
}

}  // namespace

int main(int argc, char** argv) {
    using namespace roboss;
    Options o;
    if (!parse(argc, argv, o)) {
        std::cerr << "usage: roboss_sanity FILE [--ground] [--on-ground] [--seconds S]\n";
        return 2;
    }
    Diagnostics diagnostics;
    std::optional<World> world = load_world(o.file, {{}, {}, false}, diagnostics);
    std::shared_ptr<const Model> model, awake;
    if (world && complete(*world, {.ground = o.ground, .fixed_base = {}}) && !diagnostics.refuses()) {
        model = compile(*world, {}, diagnostics);
        awake = compile(*world, {.sleep = false}, diagnostics);
    }
    if (!model || !awake) {
        nlohmann::json errors = nlohmann::json::array();
        for (const Diagnostic& d : diagnostics.items())
            if (d.severity == Severity::kError) errors.push_back(to_text(d));
        const nlohmann::json out{{"errors", errors}};
        std::cout << out.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
        return 3;
    }
    if (o.on_ground) model = stood_on_ground(*model, {o.file, 0}, diagnostics);
    std::set<std::uint32_t> types;  // that a step tells apart
    for (std::size_t r = 0; r < model->robots.size(); ++r) types.insert(model->like(RobotId(r)).value);
    const corpus::Sanity sanity = corpus::judge(*model, *awake, o.seconds);
    nlohmann::json out{{"sane", sanity.is_sane()},        {"robots", sanity.robots},
                       {"types", types.size()},           {"types_by_content", model->types.size()},
                       {"asleep", sanity.asleep},         {"not_finite_s", sanity.not_finite_s},
                       {"worst", nlohmann::json::array()}};
    for (const corpus::Figures& f : sanity.groups)
        if (out["worst"].size() < 5) out["worst"].push_back(to_json(f));
    std::cout << out << '\n';
    return sanity.is_sane() ? 0 : 1;
}
