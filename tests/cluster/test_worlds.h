// Worlds for the cluster tests, built as plain data, and control programs that keep them busy.
#pragma once

#include <memory>
#include <string>

#include "client/control_program.h"
#include "model/model.h"

namespace roboss::test {

/// Boxes and balls that fall on each other in several piles, and one long row of boxes like dominoes.
std::shared_ptr<const Model> piles_world(int piles = 4);

/// Four-wheeled carts on a plane around a wall, to be driven by a DrivingProgram; they bump into each other.
std::shared_ptr<const Model> carts_world(int carts = 6);

/// A crate that falls on a crate (robots 0 and 1), and far from them a lone crate and a lone ball (robots 2
/// and 3).
std::shared_ptr<const Model> pair_world();

/// Four stacks of three crates that fall asleep, and a ball.
std::shared_ptr<const Model> sleepers_world();

/// Gives every cart wheel speeds that depend on what it observes, a shove now and then, and remembers how
/// often it was called.
class DrivingProgram : public ControlProgram {
  public:
    explicit DrivingProgram(const ControlOptions& options) : options_(options) {}
    ControlOptions options() const override { return options_; }
    void control(Client& client) override;
    std::string memory() const override { return std::to_string(calls_); }
    void restore(const std::string& memory) override { calls_ = std::stoi(memory); }

  private:
    ControlOptions options_;
    int calls_ = 0;
};

/// Wakes the sleepers of sleepers_world() in four ways: takes the lowest of a stack away, throws a ball,
/// pulls, orders one to be where it is.
class DisturbingProgram : public ControlProgram {
  public:
    void control(Client& client) override;
    std::string memory() const override { return std::to_string(calls_); }
    void restore(const std::string& bytes) override { calls_ = std::stoi(bytes); }
    bool ok() const { return ok_; }

  private:
    int calls_ = 0;
    bool ok_ = true;
};

}  // namespace roboss::test
