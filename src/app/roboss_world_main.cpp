// roboss-world: generates worlds. One subcommand per kind of world.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <fstream>
#include <iostream>

#include "app/worlds/cell_world.h"
#include "app/worlds/city_world.h"
#include "app/worlds/joint_grid_world.h"
#include "app/worlds/soccer_world.h"
#include "app/worlds/spider_world.h"

namespace {

/// 0, or 3 after a message when the file cannot be written.
int write_world(const std::string& text, const std::string& file) {
    if (file.empty() || file == "-") {
        std::cout << text << std::flush;
        if (std::cout) return 0;
    } else {
        std::ofstream out(file, std::ios::binary);
        out << text << std::flush;
        if (out) return 0;
    }
    std::cerr << "roboss-world: cannot write " << (file.empty() ? "to standard output" : file)
              << "\n  remedy: give a file in a writable folder with free space for " << text.size()
              << " bytes\n";
    return 3;
}

/// The subcommand of cells, which fills in its options.
CLI::App* add_cells(CLI::App& app, roboss::CellOptions& cells) {
    CLI::App* make = app.add_subcommand(
        "cells",
        "cells with an arm of four axes that moves boxes from one conveyor to another, and the "
        "sensors for it\n(docs/arm-cell.md)");
    make->add_option("--cells", cells.cells, "number of cells, 1 to 1000")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    make->add_option("--gripper", cells.gripper, "fingers: they hold by friction; suction: a cup")
        ->check(CLI::IsMember({"fingers", "suction"}))
        ->capture_default_str();
    return make;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Generates worlds for RoBOSS, as SDF files.\n"
        "Exit codes: 0 done, 3 the file cannot be written, others: wrong usage."};
    app.require_subcommand(1);
    roboss::CityOptions city;
    std::string file;
    CLI::App* make_city = app.add_subcommand(
        "city",
        "a city of streets, buildings and parked obstacles, with four-wheeled cars that have a laser range\n"
        "finder, odometer, GPS and gyrocompass; more cars make a larger city of the same density");
    make_city->add_option("--cars", city.cars, "number of cars, 1 to 100000")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    make_city->add_option("--seed", city.seed, "seed of the random layout")->capture_default_str();
    roboss::JointGridOptions grid;
    CLI::App* make_grid = app.add_subcommand(
        "joint-grid", "a net of plates with a ball joint between neighbours, hanging on two corners");
    make_grid->add_option("--rows", grid.rows, "1 to 1000")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    make_grid->add_option("--columns", grid.columns, "1 to 1000")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    roboss::SoccerOptions soccer;
    CLI::App* make_soccer = app.add_subcommand(
        "soccer",
        "a field of FIRA MiroSot with two teams of two-wheeled cubes and a golf ball (docs/soccer.md)");
    make_soccer->add_option("--league", soccer.league, "small: 3 robots a side, middle: 5, large: 11")
        ->check(CLI::IsMember({"small", "middle", "large"}))
        ->capture_default_str();
    roboss::CellOptions cells;
    CLI::App* make_cells = add_cells(app, cells);
    roboss::SpiderOptions spiders;
    CLI::App* make_spiders = app.add_subcommand("spiders",
                                                "spider robots with six legs of three joints, 40 cm long, in "
                                                "a grid on some terrain (docs/spider.md)");
    make_spiders->add_option("--spiders", spiders.spiders, "number of spiders, 1 to 10000")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    make_spiders
        ->add_option("--abreast", spiders.abreast, "so many side by side, the others behind; 0: a square")
        ->check(CLI::Range(0, 10000))
        ->capture_default_str();
    make_spiders->add_option("--terrain", spiders.terrain, "flat, rubble, slope, steps")
        ->check(CLI::IsMember({"flat", "rubble", "slope", "steps"}))
        ->capture_default_str();
    make_spiders->add_option("--height", spiders.height_m, "of the largest stones, or of a step, m")
        ->check(CLI::Range(0.001, 0.5))
        ->capture_default_str();
    make_spiders->add_option("--angle", spiders.angle_deg, "of the slope, degrees")
        ->check(CLI::Range(0.0, 60.0))
        ->capture_default_str();
    make_spiders->add_option("--motor-torque", spiders.motor_torque, "bound of every motor, N m")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    make_spiders->add_option("--motor-speed", spiders.motor_speed, "bound of every motor, rad/s")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    make_spiders->add_option("--seed", spiders.seed, "seed of the stones")->capture_default_str();
    for (CLI::App* make : {make_city, make_grid, make_soccer, make_spiders, make_cells})
        make->add_option("-o,--output", file, "output file (default, or with -: standard output)");
    CLI11_PARSE(app, argc, argv);
    if (make_cells->parsed()) return write_world(roboss::cell_sdf(cells), file);
    if (make_soccer->parsed()) return write_world(roboss::soccer_sdf(soccer), file);
    if (make_spiders->parsed()) return write_world(roboss::spider_sdf(spiders), file);
    return write_world(make_grid->parsed() ? roboss::joint_grid_sdf(grid) : roboss::city_sdf(city), file);
}
