// Passes observations to a control program, and its orders to the BusClient.
#include "client/program_host.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "client/user_code.h"
#include "core/error_text.h"

namespace roboss {
namespace {

Result<ControlOptions> options_of(const ControlProgram& program, const std::string& name) {
    const UserCode mark(name, "options()");
    std::string why = "an object that is not a std::exception";
    try {
        return program.options();
    } catch (const std::exception& e) {
        why = e.what();
    } catch (...) {
    }
    return error_of_text("options() of control program '" + name + "' threw: ", why,
                         "fix it, or do in start() what may fail", "client-failed");
}

}  // namespace

Result<BusClientOptions> client_options(const ControlProgram& program, const Model& model,
                                        const std::string& name) {
    const Result<ControlOptions> given = options_of(program, name);
    if (!given) return given.error();
    const ControlOptions& options = given.value();
    const double latency_s = options.latency_s < 0 ? options.period_s : options.latency_s;
    const auto ticks = [&](double seconds) {
        return static_cast<Tick>(std::floor(seconds / model.dt_s + 0.5));
    };
    if (!(options.period_s > 0) || options.period_s > 1e9 || !(latency_s < 1e9))
        return Error{"control program '" + name + "' asks for a control period of " +
                         std::to_string(options.period_s) + " s",
                     "give a period above 0 in ControlProgram::options()"};
    BusClientOptions result;
    result.name = name;
    result.period = std::max<Tick>(ticks(options.period_s), 1);
    result.latency = ticks(latency_s);
    result.synchronous = options.synchronous;
    return result;
}

namespace {

BusClientOptions options_or_default(const ControlProgram& program, const Model& model,
                                    const std::string& name) {
    Result<BusClientOptions> options = client_options(program, model, name);
    ROBOSS_CHECK(options.ok(), "check client_options() before making a ProgramHost");
    return std::move(options).value();
}

/// The memory of a saved run: how long the sensors' part is (eight bytes), the sensors' part, the program's.
std::string joined(const std::string& samples, const std::string& program) {
    if (samples.empty() && program.empty()) return {};
    std::string memory;
    for (int i = 0; i < 8; ++i) memory.push_back(static_cast<char>(samples.size() >> (8 * i) & 0xFF));
    return memory + samples + program;
}

/// False if the bytes are too few to be a memory.
bool part(const std::string& memory, std::string& samples, std::string& program) {
    if (memory.size() < 8) return false;
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < 8; ++i)
        length |= static_cast<std::uint64_t>(static_cast<unsigned char>(memory[i])) << (8 * i);
    if (length > memory.size() - 8) return false;
    samples = memory.substr(8, length);
    program = memory.substr(8 + length);
    return true;
}

}  // namespace

ProgramHost::ProgramHost(const std::shared_ptr<const Model>& model, const Address& self, std::string name,
                         std::unique_ptr<ControlProgram> program)
    : name_(std::move(name)),
      program_(std::move(program)),
      client_(model, self, options_or_default(*program_, *model, name_)) {}

template <class Call>
bool ProgramHost::guarded(Bus& bus, const char* what, Call&& call) {
    const UserCode mark(name_, what);
    try {
        call();
        return true;
    } catch (const std::exception& e) {
        if (client_.outdated()) return false;  // it starts again with the new Model
        failure_ = std::string(what) + " threw: " + e.what();
    } catch (...) {
        failure_ = std::string(what) + " threw an object that is not a std::exception";
    }
    client_.leave(bus, failure_);
    return false;
}

bool ProgramHost::restore_all(Bus& bus) {
    std::string samples, program;
    if (!part(*restored_, samples, program)) {
        failure_ = "what a saved run remembers of it is damaged";
    } else if (const Result<> restored = client_.restore_samples(samples); !restored) {
        failure_ = restored.error().text();
    } else {
        return program.empty() || guarded(bus, "restore()", [&] { program_->restore(program); });
    }
    client_.leave(bus, failure_);
    return false;
}

void ProgramHost::advance(Bus& bus) {
    client_.advance(bus);
    if (!client_.observing() || !failure_.empty()) return;
    if (!started_) {
        started_ = true;
        if (!guarded(bus, "start()", [&] { program_->start(client_); })) return;
        if (restored_ && !restore_all(bus)) return;
    }
    const bool done = guarded(bus, "control()", [&] {
        memory_before_ = program_->memory();
        controlled_ = client_.tick();
        program_->control(client_);
    });
    if (done) client_.answer(bus);
}

std::string without_samples(const std::string& memory) {
    std::string samples, program;
    if (!part(memory, samples, program)) return memory;
    return joined({}, program);
}

std::string ProgramHost::memory_at(Tick tick) const {
    if (!started_ && restored_) return *restored_;
    return joined(client_.samples_before(tick), controlled_ >= tick ? memory_before_ : program_->memory());
}

std::optional<std::string> ProgramHost::settled_memory(Tick tick) const {
    const bool behind = client_.synchronous() && started_ && failure_.empty() && client_.expected() < tick;
    if (behind) return std::nullopt;
    return memory_at(tick);
}

}  // namespace roboss
