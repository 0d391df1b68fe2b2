// Joining a run.
#include "app/processes/member.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <random>

#include "app/commands/numbers.h"
#include "app/processes/interrupt.h"
#include "app/processes/local_process.h"
#include "app/processes/network_options.h"

namespace roboss {
namespace {

constexpr std::int64_t kTurn_ms = 10;
constexpr std::int64_t kResend_ms = 250;
constexpr std::int64_t kReportWaiting_ms = 3'000;

}  // namespace

void add_member_options(CLI::App& command, MemberOptions& o) {
    add_join_options(command, o.network);
    command
        .add_option("--patience", o.patience_s,
                    "give up after this long without a Controller, s (default: wait without limit)")
        ->check(positive_number());
    command.add_flag("--quiet", o.quiet, "print errors only");
}

void note_given(const CLI::App& command, MemberOptions& o) {
    o.named = command.get_option("--simulation")->count() > 0;
    for (const char* name : kJoinOptions) o.networked = o.networked || command.get_option(name)->count() > 0;
}

bool Member::open() {
    Result<std::unique_ptr<StreamBus>> bus = StreamBus::join(o_.network, what_, process_name(getpid()));
    if (!bus) return report_error(bus.error()), false;
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
    if (!pull.model()->ok()) return report_error(pull.model()->error()), nullptr;
    return pull.model()->value();
}

bool Member::wait() {
    bus_->wait(kTurn_ms);
    for (const std::string& line : bus_->take_notices()) report(line);
    if (const std::optional<Error> refusal = bus_->refusal()) return report_error(*refusal), false;
    const std::int64_t now = bus_->now_ms();
    if (bus_->present(kControllerAddress)) {
        seen_ms_ = now;
        waiting_reported_ = false;
        return true;
    }
    if (now - seen_ms_ > kReportWaiting_ms && !std::exchange(waiting_reported_, true))
        report(fmt::format("waiting for the Controller of {}", describe(o_.network)));
    if (o_.patience_s <= 0 || static_cast<double>(now - seen_ms_) < 1e3 * o_.patience_s) return true;
    report_error({fmt::format("no Controller of {} found for {} s", describe(o_.network), o_.patience_s),
                  o_.network.controller.empty() ? "start `roboss controller` with the same --simulation on "
                                                  "this computer, or give --controller HOST"
                                                : "start `roboss controller` there with an --interface that "
                                                  "others reach, or correct --controller",
                  "no-controller"});
    return false;
}

void Member::report(const std::string& line) const {
    if (!o_.quiet) fmt::print(stderr, "roboss {}: {}\n", what_, line);
}

void Member::report_error(const Error& error) const {
    fmt::print(stderr, "roboss {}: {}\n", what_, error.text());
}

}  // namespace roboss
