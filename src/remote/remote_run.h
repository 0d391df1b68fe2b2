// RemoteRun: a run of a Controller elsewhere, as a program sees it that steps it: a synchronous Client over
// the network. The world waits at each observation until the program steps on. Its states are those of the
// cluster, bit for bit, with the arrays and sensors of a LocalRun.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/client.h"
#include "local/run_access.h"
#include "net/net_options.h"

namespace roboss {

class BusClient;
class StreamBus;

/// Which run a RemoteRun joins, and as whom.
struct RemoteOptions {
    NetOptions network{};         ///< where the Controller is
    std::string name = "remote";  ///< as a Client; unique in the run
    Tick period = 1;              ///< ticks between observations
    Tick latency = 0;             ///< ticks from an observation to the effect of its orders
    double patience_s = 10;       ///< for a Controller that is not to be found, s
    unsigned threads = 1;         ///< that images of cameras are shared out over
};

/// See the top of the file.
class RemoteRun final : public RunAccess {
  public:
    /// Called now and then while something is waited for; false: it is given up.
    using GoOn = std::function<bool()>;

    /// Joins the run and waits for its first observation. Errors: "no-controller"; "interrupted", if go_on()
    /// said so; the run refuses the Client ("refused"). `go_on` is kept: reading the first camera waits, too.
    static Result<std::unique_ptr<RemoteRun>> connect(const RemoteOptions& options, const GoOn& go_on);

    ~RemoteRun() override;

    Tick tick() const override;
    std::uint64_t seed() const override;
    const std::vector<RobotState>& states() const override;
    Tick period() const { return options_.period; }  ///< ticks between observations

    /// Lets the world go on by `ticks`, a multiple of period(), with the orders given since. Errors:
    /// "bad-ticks"; "run-over"; "changed-world", if robots came or went; "no-controller"; "interrupted": call
    /// finish() to wait on.
    Result<> step(Tick ticks, const GoOn& go_on);
    /// Waits for the rest of a step() that was interrupted. Nothing happens if there is none.
    Result<> finish(const GoOn& go_on);

    Result<> order(std::vector<Order> orders) override;
    Result<> change(RobotId robot, const Action& action) override;

    /// A request to the run itself: pause, status ... Errors as of step().
    Result<ControlOutcome> control(const ControlAction& action, const GoOn& go_on);
    /// A request after which the run continues from another state: reset, rewind, add, remove, copy. Waits
    /// until that state is observed, or the run is outdated(); orders given since the last step() are
    /// dropped. The answer may be empty. Errors as of control(); what the run refuses.
    Result<std::string> change_run(const ControlAction& action, const GoOn& go_on);
    /// Robots came or went: only renewed() can be called.
    bool outdated() const;
    /// The same run with its present Model, by the same connection. This one can only be destroyed then.
    /// Errors as of connect().
    Result<std::unique_ptr<RemoteRun>> renewed(const GoOn& go_on);
    /// Orders that the Controller refused since the last call, one line each.
    std::vector<std::string> take_refusals();
    /// To be called now and then while nothing is stepped: takes what has come.
    void advance();
    /// Leaves the run, which continues without it; takes a moment. Nothing else may be called then.
    void leave();

  private:
    RemoteRun(std::shared_ptr<const Model> model, const RemoteOptions& options,
              std::unique_ptr<StreamBus> bus, std::unique_ptr<BusClient> client);
    static Result<std::unique_ptr<RemoteRun>> join(const RemoteOptions& options,
                                                   std::unique_ptr<StreamBus> bus, const GoOn& go_on);
    /// Waits until done(), advancing the Client; also while the Model is another one, if `even_outdated`.
    Result<> wait_until(const std::function<bool()>& done, const GoOn& go_on, bool even_outdated = false);
    /// The answer to a request; `even_outdated`: none if the run is outdated() before it comes.
    Result<std::optional<ControlOutcome>> ask(const ControlAction& action, const GoOn& go_on,
                                              bool even_outdated);

    RemoteOptions options_;
    std::unique_ptr<StreamBus> bus_;
    std::unique_ptr<BusClient> client_;
    Tick until_ = 0;  // of the step() under way
};

}  // namespace roboss
