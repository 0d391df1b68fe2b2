// PictureRenderer: renders pictures of cameras for pages in a thread of its own, of low priority and at a
// bounded rate, so that neither the run nor the gateway waits for it. It renders one set at a time: the
// states of one tick, and the pictures that pages want of it.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "gateway/camera_picture.h"
#include "gateway/exchange.h"

namespace roboss {

/// A picture that is ready; or why there is none.
struct PictureNews {
    std::uint32_t scene = 0;
    PictureWish wish;
    std::vector<std::uint8_t> message;  // binary, docs/viewer-protocol.md
    std::string why;                    // as JSON, for pages; empty: there is a picture
};

class PictureRenderer {
  public:
    /// `bell` is called from the renderer's thread when there is something to take.
    explicit PictureRenderer(std::function<void()> bell);
    /// Waits for the picture under way.
    ~PictureRenderer();
    PictureRenderer(const PictureRenderer&) = delete;
    PictureRenderer& operator=(const PictureRenderer&) = delete;

    /// The states of all robots at a tick.
    struct Job {
        std::shared_ptr<const ShownScene> scene;
        std::shared_ptr<const std::vector<std::uint8_t>>
            visuals;                     // of its Model, as the Controller sends them
        std::vector<RobotState> states;  // by RobotId
        Tick tick = 0;
        std::vector<PictureWish> wishes;
    };
    /// Whether a set may begin now: none is under way, and the last one is long enough ago.
    bool is_free() const;
    /// Begins one; only if is_free().
    void begin(Job job);
    std::vector<PictureNews> take();

  private:
    struct Studio;
    void work();

    std::function<void()> bell_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<Job> job_;
    std::vector<PictureNews> done_;
    bool busy_ = false, ends_ = false;
    std::int64_t free_from_ms_ = 0;
    std::thread thread_;
};

}  // namespace roboss
