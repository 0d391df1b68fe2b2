// LiveArray: a property of some robots as a numpy array that follows them. The states of a run lie robot by
// robot, so the rows are copied; where and when: into the same memory, after the calls that change states,
// and only while Python holds an array on it.
#pragma once

#include <nanobind/ndarray.h>

#include <memory>
#include <vector>

#include "roboss/local/robot_set.h"

namespace roboss_python {

/// See the top of the file. The GIL must be held in all calls.
class LiveArray {
  public:
    using Read = void (roboss::RobotSet::*)(const roboss::RunAccess&, std::span<double>) const;
    using Array = nanobind::ndarray<nanobind::numpy, const double>;

    /// What `read` gives of the robots of `parts` simulations, in each of which `set` is the same.
    LiveArray(std::shared_ptr<const roboss::RobotSet> set, Read read, std::size_t columns, std::size_t parts)
        : set_(std::move(set)),
          read_(read),
          columns_(columns),
          numbers_(parts * set_->size() * columns),
          versions_(parts, 0) {
        numbers_.reserve(1);  // of no robots, too, an array has an address
    }

    /// Whether Python holds an array on it.
    bool is_held() const { return holders_ > 0; }
    /// Copies the states of a part, if they are others than those that are there.
    void update(std::size_t part, const roboss::RunAccess& run);
    /// A read-only array, (parts, robots, columns), without the first axis if `is_single`. It keeps `self`
    /// alive.
    static Array array(const std::shared_ptr<LiveArray>& self, bool is_single);

  private:
    struct Holder {
        std::shared_ptr<LiveArray> live;
        explicit Holder(std::shared_ptr<LiveArray> held) : live(std::move(held)) { ++live->holders_; }
        ~Holder() { --live->holders_; }
        Holder(const Holder&) = delete;
        Holder& operator=(const Holder&) = delete;
    };

    std::shared_ptr<const roboss::RobotSet> set_;
    Read read_;
    std::size_t columns_;
    std::vector<double> numbers_;
    std::vector<std::uint64_t> versions_;  // RunAccess::version() of each part; 0: nothing was copied yet
    std::size_t holders_ = 0;
};

}  // namespace roboss_python
