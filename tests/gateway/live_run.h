// A run with a viewer in a thread of its own, with as much of `roboss run` as pages need: it paces, pauses
// and answers.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "gateway/gateway.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace roboss::test {

struct LiveRunOptions {
    bool viewer = true;
    std::string listen = "0";  // any port
    std::string page_folder;
    std::size_t simulators = 1;
    Tick end = 0;      // rests there; 0: goes on
    double speed = 1;  // simulated seconds per second; 0: as fast as it can
    bool paused = false;
    PageRole role = PageRole::kAdminister;  // the greatest that a page gets
    bool insecure = false;                  // plain also beyond loopback
    std::optional<KeyPair> certificate{};
    std::function<Result<std::vector<PageUser>>()> users{};
    std::vector<Order> orders;          // as of a file
    std::vector<TextureFile> textures;  // that the scene has
    /// For cameras; empty: there are none.
    std::function<std::vector<std::uint8_t>(const Model&)> visuals{};
};

class LiveRun {
  public:
    LiveRun(std::shared_ptr<const Model> model, const LiveRunOptions& options,
            std::vector<NamedProgram> programs = {});
    ~LiveRun();

    const std::string& url() const { return url_; }
    Gateway& gateway() { return *gateway_; }
    Tick tick() const { return tick_; }
    /// Waits until it rests at its end; then the world's hash there.
    std::uint64_t hash_at_end();
    /// The world goes on with this Model from where it is.
    void change_model(std::shared_ptr<const Model> model) {
        const std::scoped_lock lock(mutex_);
        next_model_ = std::move(model);
    }
    /// Lines of the log so far.
    std::string log();
    /// Of the log that hold these words.
    bool says(const std::string& words, int ms_max = 5'000);
    double run_cpu_s() const { return cpu_s_; }

  private:
    void live();
    void note_progress();
    void serve_calls();
    void start_again(std::shared_ptr<const Model> model);
    SimulationOptions simulation_options() const;

    LiveRunOptions options_;
    std::shared_ptr<const Model> model_;
    std::unique_ptr<Gateway> gateway_;
    std::string url_;
    std::unique_ptr<Simulation> simulation_;
    std::vector<ControlCall> calls_;
    bool paused_ = false;
    std::atomic<bool> stop_ = false, at_end_ = false;
    std::atomic<Tick> tick_ = 0;
    std::atomic<std::uint64_t> hash_ = 0;
    std::atomic<double> cpu_s_ = 0;
    std::uint64_t cpu_before_ns_ = 0;
    std::mutex mutex_;
    std::string log_;
    std::shared_ptr<const Model> next_model_;
    std::thread thread_;
};

}  // namespace roboss::test
