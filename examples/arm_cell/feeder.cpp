// The surroundings of the cells as a control program: it puts boxes onto the feed belts in loose order and
// turn, and takes away those that leave on the out belts, as people and machines before and behind a cell do.
// It sees true poses and counts what became of each box, so it also checks the cells' own counts
// (docs/arm-cell.md).
#include <array>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <roboss/app/worlds/cell_layout.h>
#include <roboss/client/control_program.h>
#include "../result_file.h"
#include "core/fixed_math.h"
#include "core/noise.h"
#include "reporting.h"

namespace arm_cell {
namespace {

constexpr const char* kResult = "ROBOSS_CELLS_FEEDER_RESULT";
constexpr double kLook = 0.1;                                // s, between two looks
constexpr double kLeastSpacing = 0.22, kMoreSpacing = 0.18;  // m along the belt, the second at random
constexpr double kAside = 0.035;                             // m, at most from the middle of the belt
constexpr double kFallen = kBeltTop - 0.05;                  // m: lower, a box has left the belts

/// Of a cell.
struct Stock {
    Place origin;  // in the world
    std::array<roboss::RobotId, kBoxes> boxes;
    std::array<bool, kBoxes> on_rack{};
    int fed = 0, delivered = 0, fallen = 0;
};

class Feeder final : public roboss::ControlProgram {
  public:
    ~Feeder() override {
        if (const auto time_s = reports_.at_end()) report_at_end([&] { report_all(*time_s); });
    }
    /// Without latency: a box that was put is seen where it was put.
    roboss::ControlOptions options() const override { return {kLook, 0, true}; }
    void start(roboss::Client& client) override;
    void control(roboss::Client& client) override;
    std::string memory() const override;
    void restore(const std::string& memory) override;

  private:
    void look(roboss::Client& client, Stock& stock) const;
    void feed(roboss::Client& client, int cell, Stock& stock) const;
    void put(roboss::Client& client, roboss::RobotId box, const Place& at, double yaw) const;
    void report_all(double time_s) const;

    std::vector<Stock> stocks_;
    Reports reports_;
};

void Feeder::start(roboss::Client& client) {
    stocks_.clear();
    reports_.start();
    examples::check_result_file(kResult);
    for (int cell = 0; client.model().find_robot(box_name(cell, 0)); ++cell) {
        Stock stock;
        const roboss::Vec3 base = client.pose(arm_name(cell), roboss::LinkId(0u)).p;
        stock.origin = {base.x, base.y, 0};
        for (int i = 0; i < kBoxes; ++i) {
            stock.boxes[static_cast<std::size_t>(i)] = client.robot(box_name(cell, i));
            stock.on_rack[static_cast<std::size_t>(i)] = true;
        }
        stocks_.push_back(stock);
    }
    if (stocks_.empty())
        throw std::runtime_error(
            "this world has no \"box_0_0\"\n"
            "  remedy: make a world with `roboss-world cells -o cells.sdf`");
}

/// At rest; `at` is in the frame of the world.
void Feeder::put(roboss::Client& client, roboss::RobotId box, const Place& at, double yaw) const {
    client.set_pose(box, {{at.x, at.y, at.z}, {roboss::fixed_cos(yaw / 2), 0, 0, roboss::fixed_sin(yaw / 2)}})
        .value();
    client.set_velocity(box, {}, {}).value();
}

/// Takes away what left on the out belt, or fell.
void Feeder::look(roboss::Client& client, Stock& stock) const {
    const Place& origin = stock.origin;
    for (int i = 0; i < kBoxes; ++i) {
        const auto n = static_cast<std::size_t>(i);
        if (stock.on_rack[n]) continue;
        const roboss::Vec3 p = client.pose(stock.boxes[n], roboss::LinkId(0u)).p;
        const bool fell = p.z<kFallen, left = p.x - origin.x> kSinkX && p.y < origin.y;
        if (!fell && !left) continue;
        ++(fell ? stock.fallen : stock.delivered);
        stock.on_rack[n] = true;
        const Place rack = rack_place(i);
        put(client, stock.boxes[n], {origin.x + rack.x, origin.y + rack.y, rack.z}, 0);
    }
}

/// Puts the next box onto the belt, if the one before it is far enough away.
void Feeder::feed(roboss::Client& client, int cell, Stock& stock) const {
    const Place& origin = stock.origin;
    const auto random = [&](std::uint64_t index) {
        const roboss::NoiseStream stream{client.seed(), static_cast<std::uint32_t>(cell), 0, stock.fed};
        return roboss::random_uniform(stream, index);
    };
    const double free = kHeadX + kLeastSpacing + kMoreSpacing * random(0);
    int next = -1;
    for (int k = 0; k < kBoxes; ++k) {
        const int i = (stock.fed + k) % kBoxes;
        const auto n = static_cast<std::size_t>(i);
        if (stock.on_rack[n]) {
            if (next < 0) next = i;
            continue;
        }
        const roboss::Vec3 p = client.pose(stock.boxes[n], roboss::LinkId(0u)).p;
        if (p.y > origin.y && p.x - origin.x < free) return;
    }
    if (next < 0) return;
    const double y = origin.y + kBeltAside + kAside * (2 * random(1) - 1);
    const double z = kBeltTop + kind_of_box(next).height / 2;
    put(client, stock.boxes[static_cast<std::size_t>(next)], {origin.x + kHeadX, y, z},
        roboss::kPi * (random(2) - 0.5));
    stock.on_rack[static_cast<std::size_t>(next)] = false;
    ++stock.fed;
}

void Feeder::report_all(double time_s) const {
    Stock sum;
    for (const Stock& stock : stocks_)
        sum.fed += stock.fed, sum.delivered += stock.delivered, sum.fallen += stock.fallen;
    report("{\"time_s\": " + whole_seconds(time_s) + ", \"fed\": " + std::to_string(sum.fed) +
               ", \"delivered\": " + std::to_string(sum.delivered) +
               ", \"fallen\": " + std::to_string(sum.fallen) + "}",
           kResult);
}

void Feeder::control(roboss::Client& client) {
    for (std::size_t i = 0; i < stocks_.size(); ++i) {
        look(client, stocks_[i]);
        feed(client, static_cast<int>(i), stocks_[i]);
    }
    if (reports_.is_due(client.time_s())) report_all(client.time_s());
}

std::string Feeder::memory() const {
    std::string text = exact(reports_.last_s);
    for (const Stock& stock : stocks_) {
        for (const bool waits : stock.on_rack) text += waits ? " 1" : " 0";
        for (const int count : {stock.fed, stock.delivered, stock.fallen})
            text += ' ' + std::to_string(count);
    }
    return text;
}

void Feeder::restore(const std::string& memory) {
    std::istringstream text(memory);
    text >> reports_.last_s;
    for (Stock& stock : stocks_) {
        for (bool& waits : stock.on_rack) text >> waits;
        text >> stock.fed >> stock.delivered >> stock.fallen;
    }
}

}  // namespace
}  // namespace arm_cell

ROBOSS_CONTROL_PROGRAM(arm_cell::Feeder)
