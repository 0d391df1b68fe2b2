// A living run with a gateway, for browsers of all kinds.
#pragma once

#include <gtest/gtest.h>

#include "browser.h"
#include "core/hash.h"
#include "live_run.h"
#include "test_worlds.h"
#include "wire/view_state.h"
#include "wire/viewer_protocol.h"

namespace roboss::test {

using Json = Browser::Json;

inline std::vector<std::size_t> coordinates_of(const Model& model) {
    std::vector<std::size_t> widths;
    for (const Robot& robot : model.robots)
        widths.push_back(view_ranges(model.types[robot.type.index()]).size());
    return widths;
}

inline std::vector<NamedProgram> driver() {
    std::vector<NamedProgram> programs;
    programs.push_back({"driver", std::make_unique<DrivingProgram>(ControlOptions{0.05, -1, true})});
    return programs;
}

inline Json watch(std::vector<int> robots, std::vector<std::string> overlays = {}, double rate = 60) {
    return {{"type", "watch"}, {"robots", robots}, {"overlays", overlays}, {"rate", rate}};
}

/// The hash that the world has at `end` when nobody watches.
inline std::uint64_t undisturbed(const std::shared_ptr<const Model>& model, Tick end) {
    LiveRunOptions options;
    options.viewer = false;
    options.end = end;
    options.speed = 0;
    return LiveRun(model, options, driver()).hash_at_end();
}

class Viewed : public testing::Test {
  protected:
    std::unique_ptr<LiveRun> begin(LiveRunOptions options = {}) {
        model = carts_world(6);
        auto run = std::make_unique<LiveRun>(model, options, driver());
        return run;
    }
    std::shared_ptr<const Model> model;
};

}  // namespace roboss::test
