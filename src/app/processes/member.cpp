// Joining a run.
#include "app/processes/member.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <random>

#include "app/commands/exit_codes.h"
#include "app/commands/numbers.h"
#include "app/output/say.h"
#include "app/processes/interrupt.h"
#include "app/processes/local_process.h"
#include "app/processes/network_options.h"
#include "core/error_text.h"
#include "visuals/visual_fetch.h"

namespace roboss {
namespace {

constexpr std::int64_t kTurn_ms = 25;  // messages end a turn sooner; many idle processes share a computer
constexpr std::int64_t kResend_ms = 250;
constexpr std::int64_t kReportWaiting_ms = 3'000;
constexpr double kPatience_s = 60;  // without the Controller of a run that has begun: it may be started again

}  // namespace

void add_member_options(CLI::App& command, MemberOptions& o) {
    add_join_options(command, o.network);
    command
        .add_option("--patience", o.patience_s,
                    "give up after this long without a Controller, s (default: wait for one without limit; "
                    "60 for one "
                    "that was there)")
        ->check(positive_number());
    command.add_flag("--quiet", o.quiet, "print errors only");
}

void note_given(const CLI::App& command, MemberOptions& o) {
    o.named = command.get_option("--simulation")->count() > 0;
    for (const char* name : kJoinOptions) o.networked = o.networked || command.get_option(name)->count() > 0;
}

bool Member::open() {
    Result<std::unique_ptr<StreamBus>> bus = StreamBus::join(o_.network, what_, process_name(getpid()));
    if (!bus) return report_error(bus.error()), exit_code_ = kBadInput, false;
    bus_ = std::move(bus).value();
    seen_ms_ = bus_->now_ms();
    watch_for_interrupts();
    return true;
}

Address Member::new_address(Role role) const {
    std::random_device device;
    return {role, static_cast<std::uint64_t>(device()) << 32 | device()};
}

std::shared_ptr<const Model> Member::fetch_model(const Address& self) {
    ModelPull pull;
    while (!pull.model()) {
        if (interrupted()) return nullptr;
        pull.advance(*bus_, self, kResend_ms);
        if (!wait()) return nullptr;
    }
    if (!pull.model()->ok()) return report_error(pull.model()->error()), exit_code_ = kBadInput, nullptr;
    return pull.model()->value();
}

render::VisualsOf Member::visuals() {
    const auto wait_here = [this]() -> Result<> {
        if (interrupted()) return Error{"interrupted", "", "interrupted"};
        if (!wait()) return Error{"there is no Controller", "start it", "no-controller"};
        return Ok{};
    };
    return fetched_visuals({*bus_, [this] { return new_address(Role::kClient); }, wait_here});
}

bool Member::wait() {
    bus_->wait(kTurn_ms);
    for (const std::string& line : bus_->take_notices()) report(line);
    exit_code_ = kBadInput;
    if (const std::optional<Error> refusal = bus_->refusal()) return report_error(*refusal), false;
    if (const std::optional<RunOver> ended = bus_->run_end_after_turn(); ended && !o_.stay)
        return exit_code_ = end(*ended), false;
    exit_code_ = kSuccess;
    const std::int64_t now = bus_->now_ms();
    if (bus_->present(kControllerAddress)) {
        seen_ms_ = now;
        was_there_ = true;
        waiting_reported_ = false;
        return true;
    }
    if (now - seen_ms_ > kReportWaiting_ms && !std::exchange(waiting_reported_, true))
        report(fmt::format("waiting for the Controller of {}", describe(o_.network)));
    const double patience_s = o_.patience_s > 0 ? o_.patience_s : was_there_ && !o_.stay ? kPatience_s : 0;
    if (patience_s <= 0 || static_cast<double>(now - seen_ms_) < 1e3 * patience_s) return true;
    return report_absence(patience_s), false;
}

void Member::report_absence(double patience_s) {
    exit_code_ = kBadInput;
    const std::string what =
        fmt::format("no Controller of {} found for {} s", describe(o_.network), patience_s);
    if (was_there_)
        return report_error({what + "; it has died, or its run was over while this process could not hear it",
                             "start it again from its journal; --patience waits longer", "no-controller"});
    report_error({what,
                  o_.network.controller.empty() ? "start `roboss controller` with the same --simulation on "
                                                  "this computer, or give --controller HOST"
                                                : "start `roboss controller` there with an --interface that "
                                                  "others reach, or correct --controller",
                  "no-controller"});
}

int Member::end(const RunOver& end) {
    if (!end.failed) return report("the run is over: " + end.reason), kSuccess;
    report_error(error_of_text("the run has failed: ", end.reason, "see the Controller", "run-failed"));
    return kRunFailed;
}

void Member::leave_at_once(const Error& why) {
    report_error(why);
    bus_->say_farewell({why.message + " [" + why.code + "]", true});
    bus_->flush(500);
    exit_code_ = kRunFailed;
}

void Member::report(const std::string& line) const {
    if (!o_.quiet) say(stderr, "roboss {}: {}\n", what_, line);
}

void Member::report_error(const Error& error) const {
    say(stderr, "roboss {}: {}\n", what_, error.text());
}

}  // namespace roboss
