// Joins a run as a Client that speaks for its robots in ROS 2.
#include "app/ros2/ros2_command.h"

#include <optional>

#include "app/commands/exit_codes.h"
#include "app/output/say.h"
#include "app/processes/crash_report.h"
#include "app/processes/interrupt.h"
#include "app/processes/member.h"
#include "app/ros2/ros2_options.h"
#include "core/error_text.h"
#include "ros2/face.h"
#include "ros2_types/open_transport.h"

namespace roboss {
namespace {

constexpr std::int64_t kGoodbye_ms = 2'000;

const char* const kRos2Footer =
    R"(Nothing of ROS has to be installed here. Nodes see one node for each robot, its sensors as topics, and drive it by the
topics of its controllers, each below the robot's name: /car_3/scan, /car_3/cmd_vel. docs/ros2.md has all of it.

Examples:
  roboss run example:city --ros2                   a run and its nodes at once
  roboss ros2                                      beside a run on this computer (`roboss controller ...`)
  roboss ros2 --list                               the topics of that run
  roboss ros2 --reach subnet --domain 7            for nodes on other computers

Exit codes: 0 the run is over or Ctrl-C, 1 an option is wrong, no Controller was found, or Fast DDS is missing, 3 the run
has failed.)";

struct Ros2ProcessOptions {
    MemberOptions member;
    Ros2Options ros2;
    std::vector<std::string> model_folders;
    bool list = false;
};

class Ros2Process {
  public:
    explicit Ros2Process(const Ros2ProcessOptions& options) : o_(options), member_("ros2", options.member) {}

    int go() {
        report_crashes({});
        const Result<ros2::TransportOptions> transport = transport_options(o_.ros2);
        if (!transport) return member_.report_error(transport.error()), kBadInput;
        if (!member_.open()) return kBadInput;
        if (o_.list) return list();
        Result<std::unique_ptr<ros2::Transport>> opened = ros2::open_transport(transport.value());
        if (!opened) return member_.report_error(opened.error()), kBadInput;
        transport_ = std::move(opened).value();
        transport_->on_arrival([this] { member_.bus().ring(); });
        ros2::Face face(*transport_, face_options(o_.ros2, o_.model_folders));
        for (;;) {
            if (!show(face)) return member_.exit_code();
            if (const std::optional<int> ended = serve(face)) return *ended;
        }
    }

  private:
    bool show(ros2::Face& face) {
        const Address self = member_.new_address(Role::kClient);
        const auto model = member_.fetch_model(self);
        if (!model) return false;
        if (Result<> shown = face.show(model, self); !shown)
            return member_.leave_at_once(shown.error()), false;
        face.set_visuals(member_.visuals());
        return true;
    }

    /// The exit code; nullopt: the run has a new Model.
    std::optional<int> serve(ros2::Face& face) {
        std::int64_t leaving_ms = 0;
        while (face.client().over().empty()) {
            const std::int64_t now = member_.bus().now_ms();
            if (leaving_ms == 0 && interrupted()) {
                leaving_ms = now;
                if (face.client().joined()) face.client().leave(member_.bus());
            }
            if (leaving_ms != 0 && (face.client().heard() || now - leaving_ms > kGoodbye_ms)) break;
            face.advance(member_.bus());
            for (const std::string& line : face.take_notices()) member_.report(line);
            if (face.client().outdated()) return std::nullopt;
            if (!face.client().refusal().empty()) return report_refusal(face.client().refusal());
            if (face.client().over().empty() && !member_.wait()) break;
        }
        member_.bus().flush(500);
        if (!face.client().over().empty()) return member_.end({face.client().over(), face.client().failed()});
        return member_.exit_code();
    }

    int report_refusal(const std::string& why) {
        member_.report_error(error_of_text("the run refuses it: ", why, "start it again", "refused"));
        return kBadInput;
    }

    int list() {
        const auto model = member_.fetch_model(member_.new_address(Role::kClient));
        if (!model) return member_.exit_code();
        const ros2::RobotTopics topics(model);
        for (const ros2::Topic& topic : topics.topics()) say("{}  {}\n", topic.name, topic.type->name);
        const ros2::RobotCommands commands(model, o_.ros2.face.stamped);
        for (const ros2::CommandTopic& topic : commands.topics())
            say("{}  {}  (drives it)\n", topic.name, topic.type->name);
        return kSuccess;
    }

    const Ros2ProcessOptions& o_;
    Member member_;
    std::unique_ptr<ros2::Transport> transport_;
};

}  // namespace

void add_ros2_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("ros2", "show a running simulation to ROS 2 nodes");
    command->footer(kRos2Footer);
    auto options = std::make_shared<Ros2ProcessOptions>();
    command->add_flag("--list", options->list, "print the topics of the run's world, and end");
    command->add_option("--name", options->ros2.face.name, "name of the Client in the run")
        ->capture_default_str();
    command->add_option("--path", options->model_folders,
                        "folder with models that nodes may spawn by name (may be repeated)");
    add_ros2_options(*command, options->ros2, "--");
    add_member_options(*command, options->member);
    command->callback([options, &exit_code] { exit_code = Ros2Process(*options).go(); });
}

}  // namespace roboss
