// roboss-world: generates worlds. One subcommand per kind of world.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <string>

#include "app/worlds/cell_world.h"
#include "app/worlds/city_world.h"
#include "app/worlds/joint_grid_world.h"
#include "app/worlds/soccer_world.h"
#include "app/worlds/spider_world.h"
#include "core/output_check.h"

namespace {

/// 0, or 3 after a message when the file cannot be written.
int write_world(const std::string& text, const std::string& file) {
    if (file.empty() || file == "-") {
        std::cout << text << std::flush;
        if (std::cout) return 0;
    } else {
        roboss::OutputCheck check;
        check.writes("--output", file, "world");
        if (const roboss::Result<> fine = check.check(); !fine) {
            std::cerr << "roboss-world: " << fine.error().text() << "\n";
            return 3;
        }
        std::ofstream out(file, std::ios::binary);
        out << text << std::flush;
        if (out) return 0;
    }
    std::cerr << "roboss-world: cannot write " << (file.empty() ? "to standard output" : file)
              << "\n  remedy: give a file in a writable folder with free space for " << text.size()
              << " bytes\n";
    return 3;
}

/// A subcommand, and the world that it makes of its options.
struct Kind {
    CLI::App* command = nullptr;
    std::function<std::string()> sdf;
};

template <class Options>
Kind kind(CLI::App* command, const std::shared_ptr<Options>& options, std::string (*sdf)(const Options&)) {
    return {command, [options, sdf] { return sdf(*options); }};
}

template <class T>
CLI::Option* add_option(CLI::App* command, const std::string& name, T& value, const std::string& help,
                        const CLI::Validator& check) {
    return command->add_option(name, value, help)->check(check)->capture_default_str();
}

Kind add_city(CLI::App& app) {
    auto options = std::make_shared<roboss::CityOptions>();
    CLI::App* make = app.add_subcommand(
        "city",
        "a city of streets, buildings and parked obstacles, with four-wheeled cars that have a laser range\n"
        "finder, odometer, GPS and gyrocompass; more cars make a larger city of the same density");
    add_option(make, "--cars", options->cars, "number of cars, 1 to 100000", CLI::Range(1, 100000));
    make->add_option("--seed", options->seed, "seed of the random layout")->capture_default_str();
    return kind(make, options, roboss::city_sdf);
}

Kind add_joint_grid(CLI::App& app) {
    auto options = std::make_shared<roboss::JointGridOptions>();
    CLI::App* make = app.add_subcommand(
        "joint-grid", "a net of plates with a ball joint between neighbours, hanging on two corners");
    add_option(make, "--rows", options->rows, "1 to 1000", CLI::Range(1, 1000));
    add_option(make, "--columns", options->columns, "1 to 1000", CLI::Range(1, 1000));
    return kind(make, options, roboss::joint_grid_sdf);
}

Kind add_soccer(CLI::App& app) {
    auto options = std::make_shared<roboss::SoccerOptions>();
    CLI::App* make = app.add_subcommand(
        "soccer",
        "a field of robot soccer with two teams and a golf ball (docs/soccer.md): FIRA MiroSot with\n"
        "two-wheeled cubes, or RoboCup's Small Size League with robots of four omnidirectional wheels");
    add_option(
        make, "--league", options->league,
        "MiroSot: small (3 robots a side), middle (5), large (11); Small Size League: ssl-b (6), ssl-a (11)",
        CLI::IsMember({"small", "middle", "large", "ssl-a", "ssl-b"}));
    make->add_flag(
        "--radio", options->radio,
        "MiroSot: robots get their commands by radio, from a station of their team beside the field");
    add_option(make, "--radio-loss", options->radio_loss,
               "probability that a robot does not get a message, 0 to 1; more than 0 implies --radio",
               CLI::Range(0.0, 1.0));
    make->callback([options] {
        options->radio = options->radio || options->radio_loss > 0;
        if (options->radio && options->league.starts_with("ssl"))
            throw CLI::ValidationError("--radio", "only the leagues small, middle and large have radios");
    });
    return kind(make, options, roboss::soccer_sdf);
}

Kind add_cells(CLI::App& app) {
    auto options = std::make_shared<roboss::CellOptions>();
    CLI::App* make = app.add_subcommand(
        "cells",
        "cells with an arm of four axes that moves boxes from one conveyor to another, and the "
        "sensors for it\n(docs/arm-cell.md)");
    add_option(make, "--cells", options->cells, "number of cells, 1 to 1000", CLI::Range(1, 1000));
    add_option(make, "--gripper", options->gripper, "fingers: they hold by friction; suction: a cup",
               CLI::IsMember({"fingers", "suction"}));
    return kind(make, options, roboss::cell_sdf);
}

Kind add_spiders(CLI::App& app) {
    auto options = std::make_shared<roboss::SpiderOptions>();
    CLI::App* make = app.add_subcommand("spiders",
                                        "spider robots with six legs of three joints, 40 cm long, in a grid "
                                        "on some terrain (docs/spider.md)");
    add_option(make, "--spiders", options->spiders, "number of spiders, 1 to 10000", CLI::Range(1, 10000));
    add_option(make, "--abreast", options->abreast, "number of spiders in a row; 0: as many as rows",
               CLI::Range(0, 10000));
    add_option(make, "--terrain", options->terrain, "flat, rubble, slope, steps",
               CLI::IsMember({"flat", "rubble", "slope", "steps"}));
    const CLI::Option* height = add_option(make, "--height", options->height_m,
                                           "of the largest stones, or of a step, m", CLI::Range(0.001, 0.5));
    const CLI::Option* angle =
        add_option(make, "--angle", options->angle_deg, "of the slope, degrees", CLI::Range(0.0, 60.0));
    add_option(make, "--motor-torque", options->motor_torque, "bound of every motor, N m, 0.01 to 1000",
               CLI::Range(0.01, 1000.0));
    add_option(make, "--motor-speed", options->motor_speed, "bound of every motor, rad/s, 0.01 to 1000",
               CLI::Range(0.01, 1000.0));
    make->add_option("--seed", options->seed, "seed of the stones")->capture_default_str();
    make->callback([options, height, angle] {
        const std::string& terrain = options->terrain;
        if (angle->count() > 0 && terrain != "slope")
            throw CLI::ValidationError("--angle", "only a slope has one: give --terrain slope");
        if (height->count() > 0 && terrain != "rubble" && terrain != "steps")
            throw CLI::ValidationError("--height",
                                       "only stones and steps have one: give --terrain rubble or steps");
    });
    return kind(make, options, roboss::spider_sdf);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Generates worlds for RoBOSS, as SDF files.\n"
        "Exit codes: 0 done, 2 wrong usage, 3 the file cannot be written."};
    app.require_subcommand(1);
    std::string file;
    const std::array kinds{add_city(app), add_joint_grid(app), add_soccer(app), add_cells(app),
                           add_spiders(app)};
    for (const Kind& each : kinds)
        each.command->add_option("-o,--output", file, "output file (default, or with -: standard output)");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    const auto* const chosen = std::ranges::find_if(kinds, [](const Kind& k) { return k.command->parsed(); });
    return write_world(chosen->sdf(), file);
}
