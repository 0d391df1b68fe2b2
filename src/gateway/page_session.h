// PageSession: one browser's WebSocket. It is read at a bounded rate and written at the pace at which it
// reads: one State is under way at most, and who is slow gets the latest one next.
#pragma once

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <memory>
#include <string>

#include "core/rate_limit.h"
#include "gateway/access.h"
#include "gateway/page_request.h"
#include "gateway/page_stream_session.h"
#include "gateway/view_state_cache.h"

namespace roboss {

class ServerCore;

class PageSession : public std::enable_shared_from_this<PageSession> {
  public:
    using Request = boost::beast::http::request<boost::beast::http::empty_body>;

    PageSession(PageStream&& stream, ServerCore& core, std::uint64_t number, std::string peer, PageUser user);

    void start(const Request& request);
    void close();
    /// Closes it by the protocol, after the lines that wait.
    void leave();
    std::uint64_t number() const { return number_; }
    const std::string& peer() const { return peer_; }
    const PageUser& user() const { return user_; }
    /// Its number, user and computer, for the log.
    std::string title() const;
    /// Disconnects it; it hears why.
    void expel(const std::string& why, const std::string& code) { end(why, code); }
    const PageWatch& watch() const { return watch_; }
    std::uint64_t sent_bytes() const { return sent_bytes_; }
    bool open() const { return open_; }

    /// Sends the hello line, once; false: it has been sent.
    bool greet();
    /// A line of text. `may_miss`: it is dropped where others wait already.
    void send(std::string text, bool may_miss);
    /// A State message of an earlier moment; it follows the lines that wait. The newest counts.
    void show_preview(std::vector<std::uint8_t> state);
    /// A Picture message; of those of one camera that wait the newest counts.
    void show_picture(const PictureWish& wish, std::vector<std::uint8_t> message);
    /// The world has moved: a State is sent when it is due.
    void show_state();
    /// The scene is another one: the next State is whole.
    void begin_scene();

  private:
    void read();
    void take(const std::string& text);
    void write_next();
    /// `why` and its code are for the log and for the page, if it comes back; empty: it left by itself.
    void end(const std::string& why = {}, const std::string& code = {});
    void close_because(const std::string& why);
    bool state_due();
    bool extras_due();

    boost::beast::websocket::stream<PageStream> socket_;
    ServerCore& core_;
    std::uint64_t number_;
    std::string peer_;  // the address of its computer
    PageUser user_;
    boost::asio::steady_timer timer_;
    boost::beast::flat_buffer buffer_;
    RateLimit rate_;
    PageWatch watch_;
    bool open_ = false, ended_ = false, writing_ = false, state_wanted_ = false, timing_ = false,
         greeted_ = false, leaving_ = false;
    std::uint64_t before_ = 0;  // the number of this page in its last connection; 0: none
    std::deque<std::string> lines_;
    std::string line_under_way_;
    std::vector<std::uint8_t> state_under_way_, preview_;
    std::deque<std::pair<PictureWish, std::vector<std::uint8_t>>> pictures_;
    bool state_was_last_ = false;  // States and pictures take turns
    ViewStateCache::Shelf shelf_;
    std::int64_t state_ms_ = 0, extras_ms_ = 0;
    std::uint64_t sent_bytes_ = 0;
};

}  // namespace roboss
