// Triggers: the control program that a world with a message board brings along. It watches contacts and
// regions, publishes what happens on the board, passes messages on, drops breadcrumbs and guides actors
// (TouchPlugin, PerformerDetector, TriggeredPublisher, Breadcrumbs, FollowActor). It gives ordinary orders,
// so journals and replays need nothing of it.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "client/control_program.h"
#include "client/triggers/board_watch.h"
#include "client/triggers/contact_watch.h"
#include "model/topics.h"

namespace roboss {

/// Whether a robot of the world is a message board.
bool has_message_board(const Model& model);

/// Observes the world every kPeriod, or at every tick if a touch of less than two periods counts. Its orders
/// take effect at the tick that it has observed.
class Triggers : public ControlProgram {
  public:
    static constexpr double kPeriod = 0.01;           ///< s
    static constexpr const char* kName = "triggers";  ///< as a Client

    /// `told`: gets a line for each message that it publishes, for logs.
    explicit Triggers(std::shared_ptr<const Model> model,
                      std::function<void(Tick, const std::string&)> told = {});

    ControlOptions options() const override { return {period_, 0, true}; }
    void start(Client& client) override { seen_ = client.tick(); }
    void control(Client& client) override;
    std::string memory() const override;
    void restore(const std::string& bytes) override;

  private:
    /// A message with the names of its values; `values` as in the state of the channel that it was on.
    struct Message {
        std::string topic;
        std::vector<BoardValue> values;
    };
    /// An output of a trigger that is still to come.
    struct Pending {
        Tick due = 0;
        std::uint32_t board = 0, trigger = 0, output = 0;
    };
    struct Touch {
        ContactWatch watch;
        bool enabled;
        Tick since = -1;  // the touch began; -1: none
    };
    struct Board {
        RobotId robot;
        const MessageBoardSpec* spec;
        std::vector<Touch> touches;
        std::vector<char> inside;  // by detector
        BoardWatch watch;
    };
    /// What the program remembers, as an archive's fields.
    template <class A, class Self>
    static void remember(A& a, Self& self);

    void read_messages(Client& client);
    Message message_at(const Client& client, const TopicPlace& place) const;
    void react(const Message& message, Tick tick);
    void watch_others(Client& client, Board& board);
    void watch_touches(Client& client, Board& board);
    void watch_regions(Client& client, Board& board);
    Transform pose_of(const Client& client, const std::string& model) const;
    void publish_due(Client& client);
    void tell(Client& client, const Board& board, const std::string& channel, std::vector<BoardValue> values);
    void publish(Client& client, const BoardOutput& output);
    void give(Client& client, const TopicPlace& place, const Message& message);

    std::shared_ptr<const Model> model_;
    std::function<void(Tick, const std::string&)> told_;
    double period_ = kPeriod;  // s
    std::vector<Board> boards_;
    std::map<std::string, std::vector<TopicPlace>> places_;  // of the topics in use
    std::vector<TopicPlace> inputs_;                         // that are watched, ascending

    Tick seen_ = 0;                // the last observation
    std::vector<TopicPlace> own_;  // commands that it gave itself then
    std::deque<Pending> pending_;  // by due tick, then as they came
};

}  // namespace roboss
