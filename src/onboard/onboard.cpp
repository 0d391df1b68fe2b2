// See onboard.h.
#include "onboard/onboard.h"

#include "onboard/controllers.h"

namespace roboss {

void run_onboard(const Model& model, Tick tick, RobotId robot, RobotState& state, OnboardScratch& scratch) {
    scratch.pushed.assign(state.motors.size(), 0), scratch.out_of_power = false;
    OnboardContext context(model, tick, robot, state, scratch);
    for (const OnboardInfo& info : model.type_of(robot).onboard) {
        context.select(info);
        std::visit([&](const auto& spec) { run(spec, context); }, info.spec.parameters);
    }
}

bool onboard_rests(const RobotType& type, const RobotState& state) {
    for (const OnboardInfo& info : type.onboard) {
        const auto memory =
            std::span(state.onboard).subspan(static_cast<std::size_t>(info.memory_index), info.memory.size());
        const bool rests = std::visit(
            [&](const auto& spec) {
                if constexpr (requires { spec.rests(memory); }) return spec.rests(memory);
                return true;
            },
            info.spec.parameters);
        if (!rests) return false;
    }
    return true;
}

}  // namespace roboss
