// What a message board watches besides contacts and regions: it drops breadcrumbs, tells actors where their
// targets are, reads sensors whose readings are messages, and publishes what controllers report. It remembers
// nothing: what is still to do follows from the states of the robots and of the board.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/client.h"
#include "onboard_kinds/message_board.h"

namespace roboss {

class BoardWatch {
  public:
    /// What it does with a message of the board's own: the name of the channel, the values.
    using Tell = std::function<void(const std::string&, std::vector<BoardValue>)>;
    /// What it does with a reading: the topic, the values.
    using Publish = std::function<void(const std::string&, std::vector<BoardValue>)>;

    BoardWatch(const Model& model, RobotId board, const MessageBoardSpec& spec);

    /// Reads the sensors that have measured at this observation.
    void read_sensors(Client& client, const Publish& publish) const;
    /// Tells what controllers report that is new.
    void report(Client& client, const Tell& tell) const;
    /// Tells the actors where their targets are, if these have moved.
    void guide_actors(Client& client) const;
    /// Drops the crumbs that were asked for.
    void drop_crumbs(Client& client, const Tell& tell) const;

  private:
    /// A robot, and one number in its RobotState::onboard.
    struct Place {
        RobotId robot;
        std::size_t index = 0;
        double in(const Client& client) const { return client.state(robot).onboard[index]; }
    };
    /// A part of a crumb: a robot and its command "dropped".
    struct Part {
        RobotId robot;
        std::uint32_t dropped = 0;  // channel
        std::size_t at = 0;         // of its tick in RobotState::onboard
        Pose X_CP;                  // the part in the crumb's frame
    };
    struct Supply {
        const BoardSupply* spec;
        Place count;  // of the commands
        RobotId carrier;
        std::vector<std::vector<Part>> crumbs;
    };
    struct Sensor {
        const BoardSensor* spec;
        RobotId robot;
        std::size_t sensor = 0;
    };
    struct Report {
        const BoardReport* spec;
        Place number;
        std::size_t told = 0;  // of the board's last message in its RobotState::onboard
        bool with_pose = false;
    };
    struct Follower {
        RobotId actor;
        std::uint32_t channel = 0;
        std::size_t at = 0;  // of the command in RobotState::onboard
        const BoardFollower* spec;
        RobotId target;  // not valid: scenery
    };

    void add_supply(const BoardSupply& supply);
    std::vector<Part> parts_of(const std::string& crumb) const;
    void add_sensor(const BoardSensor& sensor);
    void add_report(const BoardReport& report);
    void add_follower(const BoardFollower& follower);
    void drop(Client& client, const std::vector<Part>& crumb, const Pose& X_WC) const;

    const Model* model_;
    RobotId board_;
    std::vector<Supply> supplies_;
    std::vector<Sensor> sensors_;
    std::vector<Report> reports_;
    std::vector<Follower> followers_;
};

}  // namespace roboss
