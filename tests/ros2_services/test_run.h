// TestRun: a real run in this process, served as `roboss run` serves it, and a Client through which services
// of ROS 2 reach it. Each turn advances the world a little, or lets it rest.
#pragma once

#include <gtest/gtest.h>

#include <support/ros2_transport.h>

#include <memory>
#include <optional>
#include <string>

#include "client/bus_client.h"
#include "model/edit.h"
#include "ros2/bus_run_control.h"
#include "ros2/simulation_services.h"
#include "simulation/simulation.h"

namespace roboss::test {

class TestRun {
  public:
    /// A world as SDF; at first it is paused.
    explicit TestRun(const std::string& sdf, ros2::SimulationOptions options = {});

    /// One turn of everything.
    void turn();
    /// Turns until the condition holds; false: it does not in good time.
    bool until(const std::function<bool()>& condition);
    /// Calls a service and waits for the reply.
    template <ros2::Service S>
    typename S::Response call(const std::string& service, const typename S::Request& request,
                              const std::string& peer_type = "") {
        const std::string bytes = wait_for(transport.call(service, ros2::to_cdr(request), peer_type));
        const auto response = ros2::from_cdr<typename S::Response>(bytes);
        EXPECT_TRUE(response) << service;
        return response ? response.value() : typename S::Response{};
    }
    /// The bytes of the reply to a call.
    std::string wait_for(std::int64_t call);

    const Model& model() const { return *model_; }
    Tick tick() const { return simulation_->tick(); }
    bool paused() const { return paused_; }

    TestTransport transport;
    ros2::BusRunControl control;
    std::unique_ptr<ros2::SimulationServices> services;
    /// Also takes calls, and is called in each turn of the Client.
    std::function<void(const ros2::Incoming&)> take;
    std::function<void(std::int64_t now_ms)> advance;

  private:
    void begin(const std::shared_ptr<const Model>& model, const SavedRun* from);
    void look(Bus& bus);
    ControlOutcome execute(const ControlAction& action);
    ControlOutcome change(const Result<ModelEdit>& edit);

    std::shared_ptr<const Model> world_, model_;
    std::unique_ptr<Simulation> simulation_;
    std::unique_ptr<BusClient> client_;
    std::uint32_t clients_ = 0;
    bool paused_ = true;
    std::optional<Tick> step_until_;
};

/// A ball above the ground, and an arm with two joints on it.
std::string ball_and_arm();
/// A box, as the description of a model.
std::string box_model(const std::string& name = "box");

}  // namespace roboss::test
