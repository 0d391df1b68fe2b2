// Requests to a run over a Unix socket, for `roboss control` on the same computer. A connection carries one
// request and its reply, each as a length (four bytes, little-endian) and an encoded Envelope (wire/codec.h).
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/result.h"
#include "wire/control.h"

namespace roboss {

/// The end of the run. Calls arrive on a thread of its own; the run takes and answers them on its thread.
class ControlSocket {
  public:
    /// A request that waits for its reply. Closed without one, the requester reports that the run ended.
    class Call {
      public:
        Call(int connection, ControlAction action) : connection_(connection), action_(std::move(action)) {}
        Call(Call&& other) noexcept
            : connection_(std::exchange(other.connection_, -1)), action_(std::move(other.action_)) {}
        Call& operator=(Call&&) = delete;
        ~Call();
        const ControlAction& action() const { return action_; }
        /// Sends the reply; a requester that has gone or does not read is given up after two seconds.
        void answer(ControlOutcome outcome);

      private:
        int connection_;
        ControlAction action_;
    };

    /// Listens at this path, which must not exist and must have at most 100 characters.
    static Result<std::unique_ptr<ControlSocket>> open(const std::filesystem::path& path);
    ~ControlSocket();
    /// Whether a request waits; costs one atomic read.
    bool has_calls() const { return waiting_.load(std::memory_order_acquire); }
    std::vector<Call> take_calls();

  private:
    ControlSocket(int listener, int wake, std::filesystem::path path);
    void serve();
    void accept_one();

    int listener_, wake_;
    std::filesystem::path path_;
    std::atomic<bool> waiting_ = false, ended_ = false;
    std::mutex mutex_;
    std::vector<Call> calls_;
    std::thread thread_;
};

/// Sends a request to the run that listens there, and waits for the reply. An Error if nothing listens, if
/// the run ends first, or if it is of another version of RoBOSS.
Result<ControlOutcome> ask_run(const std::filesystem::path& socket, const ControlAction& action);

}  // namespace roboss
