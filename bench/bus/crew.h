// Crew: a Controller's Bus and members' in processes of their own. This process only starts them and asks the
// centre to measure; it has no thread besides, so that it may fork.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace roboss::bench {

class Crew {
  public:
    /// Starts the centre, then all members at once, and waits until each has sent something and got an
    /// answer. Throws std::runtime_error if they do not come together within a minute.
    explicit Crew(int members);
    ~Crew();
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    /// From the start of the first member's process until the last one has joined.
    double joined_s() const { return joined_s_; }
    /// Median time of a message to the first member and back.
    double round_trip_us(std::size_t bytes);
    /// Median time from a message to every member until all have answered.
    double barrier_ms(std::size_t bytes);
    struct Idle {
        double centre_ms_per_s = 0, member_ms_per_s = 0;
    };
    /// CPU time of the processes while no messages are sent.
    Idle idle(double seconds) const;
    /// Kills the last member's process, until the centre's Bus reports that it has vanished.
    double kill_seen_ms();

  private:
    double ask(const std::string& question);
    pid_t centre_ = 0;
    std::vector<pid_t> members_;
    int to_centre_ = -1, from_centre_ = -1;
    double joined_s_ = 0;
};

}  // namespace roboss::bench
