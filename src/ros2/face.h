// Face: a run as nodes of ROS 2 see it. It is an ordinary Client: it shows the robots' sensors as topics and
// gives the orders that nodes send. What nobody subscribes to is neither computed nor sent, but for latched
// topics.
//
// The world is the node "/roboss"; each robot has a node "robot" in its namespace: "/car_3/robot".
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client/bus_client.h"
#include "ros2/face_services.h"
#include "ros2/lockstep.h"
#include "ros2/robot_commands.h"
#include "ros2/robot_topics.h"
#include "ros2_types/transport.h"

namespace roboss::ros2 {

/// Options of a Face.
struct FaceOptions {
    std::string name = "ros2";    ///< of the Client
    double period_s = 0;          ///< between two looks at the world; 0: that of the fastest sensor
    TopicOptions topics;          ///< names and frames
    FaceServiceOptions services;  ///< of the world's node
    /// The world waits for a message of each of these topics in each period; empty: it does not wait.
    std::vector<std::string> lockstep;
};

/// See the top of the file.
class Face {
  public:
    /// `transport` outlives it.
    Face(Transport& transport, FaceOptions options);
    /// Its nodes go, with all that they have.
    ~Face();
    Face(const Face&) = delete;
    Face& operator=(const Face&) = delete;

    /// Shows this world from now on; topics that the world before had, too, stay as they are. `self`: a new
    /// address. An Error: a lockstep topic is none of this world.
    Result<> show(std::shared_ptr<const Model> model, const Address& self);
    /// Cameras render these visuals.
    void set_visuals(const render::VisualsOf& visuals) { client_->set_visuals(visuals); }
    /// A turn: takes what arrived from both sides, and shows what is new. Waits only for confirmations, in
    /// lockstep.
    void advance(Bus& bus);
    /// Warnings and refusals since the last call, one line each.
    std::vector<std::string> take_notices();
    /// The Client that it is.
    BusClient& client() { return *client_; }

  private:
    struct Endpoint {
        EntityId id = 0, node = 0;
        std::string type;
    };
    using Endpoints = std::map<std::string, Endpoint>;  // by topic

    void open_nodes();
    void use_services();
    void open_topics();
    void open_commands();
    EntityId node_of(RobotId robot) const;
    static bool take_over(Endpoints& before, Endpoints& now, const std::string& topic,
                          const std::string& type, EntityId node);
    void close(const Endpoints& endpoints);

    void take_messages(Bus& bus);
    bool take_command(std::size_t topic, const std::string& cdr);
    void obey(std::size_t topic, std::string_view cdr);
    void follow_types(std::int64_t now_ms);
    void report_lockstep(std::int64_t now_ms);
    void observe(Bus& bus);
    bool is_ready(std::int64_t now_ms);
    void publish_latched();
    void publish_observed(const std::vector<bool>& wanted);
    void publish_to_late(std::int64_t now_ms);
    void confirm(const std::vector<EntityId>& sent);
    const std::vector<std::size_t>& count_subscribers();
    Result<std::optional<Sample>> measure(RobotId robot, std::size_t sensor);
    void answer_when_complete(Bus& bus);
    void report_waiting(std::int64_t now_ms, const std::vector<std::size_t>& topics, const char* what);
    void notice(const std::string& line);

    Transport& transport_;
    FaceOptions options_;
    std::shared_ptr<const Model> model_;
    std::unique_ptr<BusClient> client_;
    std::unique_ptr<RobotTopics> topics_;
    std::unique_ptr<RobotCommands> commands_;
    std::optional<Lockstep> lockstep_;

    EntityId world_node_;
    FaceServices services_;
    std::map<std::string, EntityId> nodes_;  // of robots, by namespace without "/"
    std::vector<EntityId> robot_nodes_;      // the same by RobotId
    Endpoints publishers_, subscriptions_;
    std::vector<EntityId> publisher_of_;                    // of topics_->topics(); 0: it could not be made
    std::multimap<EntityId, std::size_t> command_of_;       // in commands_->topics()
    std::set<std::pair<std::size_t, std::size_t>> broken_;  // robot and sensor that could not measure

    // In lockstep: the subscribers of topics_->topics() when the observation was published; before that, when
    // they changed last.
    std::vector<std::size_t> subscribers_;
    std::int64_t settled_ms_ = 0;
    bool ready_ = false;

    std::vector<std::size_t> counted_;           // subscribers, by topic
    std::optional<std::uint64_t> counted_at_{},  // revision of the transport then; none: count
        types_followed_at_{};                    // when types were compared last
    std::int64_t types_followed_ms_ = 0;
    Tick shown_ = -1;           // the observation whose sensors were published last
    std::size_t welcomes_ = 0;  // of the Client, when shown_ was set
    std::int64_t waiting_since_ms_ = 0;
    bool waiting_told_ = false;
    std::uint64_t misplaced_ = 0;  // messages that were reported to be early or dropped
    std::int64_t report_lockstep_ms_ = 0;
    std::set<std::string> told_;  // notices that were given
    std::vector<std::string> notices_;
};

/// Between two looks at a world, in ticks: the shortest interval of its sensors, no more than 20 ms.
Tick usual_period(const Model& model);

}  // namespace roboss::ros2
