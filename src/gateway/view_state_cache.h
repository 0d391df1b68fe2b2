// ViewStateCache: the latest view state of every robot, and what each page has of it. A page is sent the
// entries whose bytes differ from those it got last, so that a page that missed some is right again with the
// next State.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gateway/exchange.h"

namespace roboss {

class ViewStateCache {
  public:
    void begin(std::shared_ptr<const ShownScene> scene);
    /// Views of another Model, damaged ones and such that come late are left out. False: nothing was taken.
    bool take(const ViewStates& views, std::int64_t now_ms);
    bool known() const { return scene_ != nullptr && heard_ > 0; }
    /// Every robot has been shown at tick().
    bool complete() const { return at_newest_ == scene_->layout.robots(); }
    Tick tick() const { return tick_; }

    /// Surfaces in motion and bonds of the robots that were shown, by robot.
    const ViewExtras& extras() const { return extras_; }
    /// Of extras(): another number after each change; 0: there have been none.
    std::uint64_t extras_serial() const { return extras_serial_; }

    /// What one page got.
    struct Shelf {
        std::vector<std::uint8_t> entries;
        std::vector<char> sent;    // by RobotId
        bool whole = true;         // the next State is to be
        std::uint64_t extras = 0;  // serial of those it has
    };
    /// The State message that brings the page up to date.
    std::vector<std::uint8_t> message(Shelf& shelf) const;

  private:
    void take_extras(const ViewExtras& extras);

    std::shared_ptr<const ShownScene> scene_;
    std::vector<std::size_t> offsets_;  // by RobotId, in entries_
    std::vector<std::uint8_t> entries_;
    std::vector<std::uint64_t> stamps_;  // by RobotId: (epoch, serial) of the entry; 0: none yet
    std::vector<char> renewed_;          // by RobotId: its entry came with the views at hand
    ViewExtras extras_;
    std::uint64_t extras_serial_ = 0;
    std::size_t heard_ = 0, at_newest_ = 0;
    std::uint64_t newest_ = 0;
    Tick tick_ = 0;
    bool rests_ = false;
    std::int64_t taken_ms_ = 0;
};

}  // namespace roboss
