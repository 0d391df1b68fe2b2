// See face_process.h.
#include "app/ros2/face_process.h"

#include <optional>

#include "app/commands/exit_codes.h"
#include "app/output/say.h"
#include "app/processes/client_loop.h"
#include "app/processes/crash_report.h"
#include "core/error_text.h"
#include "ros2/bridge.h"
#include "ros2/robot_controllers.h"
#include "ros2/robot_names.h"

namespace roboss {
namespace {

class FaceProcess {
  public:
    FaceProcess(const char* what, const FaceProcessOptions& options, const ros2::FaceOptions& face,
                const TransportOpener& open)
        : o_(options), face_(face), open_(open), member_(what, options.member) {}

    int go() {
        report_crashes({});
        if (!member_.open()) return kBadInput;
        if (o_.list) return list();
        Result<std::unique_ptr<ros2::Transport>> opened = open_();
        if (!opened) return member_.report_error(opened.error()), kBadInput;
        transport_ = std::move(opened).value();
        transport_->on_arrival([this] { member_.bus().ring(); });
        ros2::Face face(*transport_, face_);
        for (;;) {
            if (const std::optional<int> refused = show(face)) return *refused;
            if (const std::optional<int> ended = serve(face)) return *ended;
        }
    }

  private:
    /// The exit code if it cannot; nullopt: it does.
    std::optional<int> show(ros2::Face& face) {
        const Address self = member_.new_address(Role::kClient);
        const auto model = member_.fetch_model(self);
        if (!model) return member_.exit_code();
        if (Result<> shown = face.show(model, self); !shown)
            return member_.report_error(shown.error()), kBadInput;
        face.set_visuals(member_.visuals());
        return {};
    }

    /// The exit code; nullopt: the run has a new Model.
    std::optional<int> serve(ros2::Face& face) {
        const ClientEnd end = serve_client(member_, face.client(), [&] {
            face.advance(member_.bus());
            for (const std::string& line : face.take_notices()) member_.report(line);
            return true;
        });
        if (end == ClientEnd::kNewModel) return std::nullopt;
        if (end == ClientEnd::kRefused) return report_refusal(face.client().refusal());
        return client_exit_code(member_, face.client());
    }

    int report_refusal(const std::string& why) {
        member_.report_error(error_of_text("the run refuses it: ", why, "start it again", "refused"));
        return kRunFailed;  // not kBadInput: a run then starts it again
    }

    int list() {
        const auto model = member_.fetch_model(member_.new_address(Role::kClient));
        if (!model) return member_.exit_code();
        const ros2::RobotTopics shown(model, face_.topics);
        const ros2::RobotCommands obeyed(model, face_.topics);
        for (const std::string& line : shown.bridge_notices()) member_.report(line);
        if (face_.topics.controllers) {
            const auto names = ros2::robot_names(*model, face_.topics.root);
            for (const std::string& line : ros2::controller_notices(*face_.topics.controllers, *model, names))
                member_.report(line);
        }
        for (const ros2::Topic& topic : shown.topics()) say("{}  {}\n", topic.name, topic.type->name);
        for (const ros2::CommandTopic& topic : obeyed.topics())
            say("{}  {}  (drives it)\n", topic.name, topic.type->name);
        return kSuccess;
    }

    const FaceProcessOptions& o_;
    const ros2::FaceOptions& face_;
    const TransportOpener& open_;
    Member member_;
    std::unique_ptr<ros2::Transport> transport_;
};

}  // namespace

void add_face_process_options(CLI::App& command, FaceProcessOptions& options, ros2::FaceOptions& face) {
    command.add_flag("--list", options.list, "print the topics of the run's world, and end");
    command.add_option("--name", face.name, "name of the Client in the run")->capture_default_str();
    command.add_option("--path", face.services.simulation.model_folders,
                       "folder with models that nodes may spawn by name (may be repeated)");
    add_member_options(command, options.member);
}

int show_run(const char* what, const FaceProcessOptions& options, const ros2::FaceOptions& face,
             const TransportOpener& open) {
    return FaceProcess(what, options, face, open).go();
}

}  // namespace roboss
