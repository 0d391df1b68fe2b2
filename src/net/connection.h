// Connection: one connection to another process of the run. It encrypts, cuts messages into frames and joins
// them, and sends as much as the network takes; the rest waits here. Short messages overtake the pieces of
// long ones.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "net/frames.h"
#include "net/tls.h"

namespace boost::asio {
class io_context;
}

namespace roboss {

class Connection : public std::enable_shared_from_this<Connection> {
  public:
    /// Called in the thread of the io_context, without a lock.
    struct Events {
        /// The other end can be judged: TLS is established, or there is none.
        std::function<void(Connection&)> ready;
        /// A frame that is no piece of a message.
        std::function<void(Connection&, const Frame&)> frame;
        /// A whole message.
        std::function<void(Connection&, std::vector<std::uint8_t>)> message;
        /// It has ended; the last call.
        std::function<void(Connection&, const std::string& reason)> closed;
    };

    /// Takes over a connected socket. Without a session nothing is encrypted.
    static std::shared_ptr<Connection> open(boost::asio::io_context& context, int socket,
                                            std::unique_ptr<TlsSession> session, Events events);
    ~Connection();

    /// Any thread. False: it has ended, or more than `kWaitingMost` bytes wait already.
    bool send_message(std::vector<std::uint8_t> bytes, bool urgent);
    bool send_frame(FrameKind kind, const std::vector<std::uint8_t>& content, bool urgent = true);
    /// Any thread: sends what waits, and nothing more; then the other end closes it, or close().
    void close_after_sending();
    /// Any thread.
    void close(const std::string& reason);
    /// Any thread: nothing is read any more, so that the other end has to wait, until resume().
    void pause();
    void resume();

    /// The other end is silent: what waits is dropped. The kernel watches whether it is there.
    void turn_deaf();

    /// Nothing waits here, nor in this computer's kernel.
    bool all_sent() const;
    bool ended() const { return ended_; }
    /// Since when it is to end (close_after_sending()); 0: it is not.
    std::int64_t closing_ms() const { return closing_ms_; }
    bool paused() const { return paused_; }
    std::int64_t opened_ms() const { return opened_ms_; }
    std::int64_t heard_ms() const { return heard_ms_; }
    std::int64_t sent_ms() const { return sent_ms_; }
    /// Null: not encrypted.
    const TlsSession* session() const { return session_.get(); }
    /// "192.0.2.7:41233", of the other end.
    const std::string& where() const { return where_; }

    /// "'sim-3' node7/4711 at 192.0.2.7:41233": all that is known about the other end, for the log.
    std::string who() const;

    // The owner keeps here what it knows about the other end.
    std::atomic<bool> accepted = false;
    std::atomic<bool> deaf = false;  // see turn_deaf(); what it still says does not count
    bool no_room = false;            // taken only to be refused
    std::set<Address> had;           // of a deaf one
    Caller hello;
    std::shared_ptr<const Rights> rights;  // of its key; null: all

    static constexpr std::size_t kWaitingMost = std::size_t{256} << 20;

  private:
    struct Socket;
    struct Outgoing {
        std::vector<std::uint8_t> bytes;
        std::size_t at = 0;
        FrameKind kind{};  // kWhole: may be cut into pieces
    };

    Connection(boost::asio::io_context& context, int socket, std::unique_ptr<TlsSession> session,
               Events events);
    void read();
    void receive(std::span<const std::uint8_t> data);
    bool take(const Frame& frame);
    void wait_until_writable();
    std::string pump_locked();
    bool fill_locked(std::string& failure);
    void add_pieces_locked();
    bool queue(std::deque<Outgoing>& line, Outgoing message);
    void end_after_reading(const std::string& reason);
    void end(const std::string& reason);

    std::unique_ptr<Socket> socket_;
    Events events_;
    std::string where_;
    std::int64_t opened_ms_;
    std::atomic<std::int64_t> heard_ms_, sent_ms_;
    std::atomic<bool> ended_ = false, paused_ = false;
    bool reading_ = false, announced_ = false;
    FrameReader reader_;
    std::vector<std::uint8_t> joined_;

    mutable std::mutex mutex_;  // of what follows
    std::unique_ptr<TlsSession> session_;
    std::deque<Outgoing> urgent_, waiting_;
    std::size_t waiting_bytes_ = 0;
    std::vector<std::uint8_t> plain_, wire_;  // scratch; what the socket is to take next
    std::size_t wire_at_ = 0;
    bool waits_ = false;
    std::atomic<std::int64_t> closing_ms_ = 0;  // since when it is to end; 0: it is not
    bool shut_ = false;
};

}  // namespace roboss
