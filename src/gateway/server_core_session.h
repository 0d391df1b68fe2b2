// ServerCore: what the sessions of the gateway's thread share. Everything in it belongs to that thread, but
// for the notices and the counters.
#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/rate_limit.h"
#include "gateway/access.h"
#include "gateway/exchange.h"
#include "gateway/gateway.h"
#include "gateway/inspector.h"
#include "gateway/page_files.h"
#include "gateway/picture_renderer.h"
#include "gateway/view_state_cache.h"

namespace roboss {

class HttpSession;
class PageSession;

/// Why a page was disconnected; empty: it left by itself.
struct Farewell {
    std::string why, code;
};

class ServerCore {
  public:
    /// `tls`: of the certificate of the options; nullptr: pages are plain.
    ServerCore(const GatewayOptions& options, Access access, std::shared_ptr<boost::asio::ssl::context> tls,
               std::shared_ptr<Exchange> exchange);
    ~ServerCore();

    /// Binds and listens; an Error if the port is taken.
    Result<> listen(const ListenAddress& address);
    std::uint16_t port() const;
    void start();
    /// Says to all pages why the run is over and closes them; waits for that, but not long.
    void say_farewell(const RunOver& over);
    void stop();

    // --- for sessions
    const Access& access() const { return access_; }
    boost::asio::ssl::context* tls() const { return tls_.get(); }
    const PageFiles& files() const { return files_; }
    bool framed() const { return options_.framed; }
    const std::shared_ptr<const ShownScene>& scene() const { return scene_; }
    const ViewStateCache& book() const { return order_log_; }
    /// The first line; it says why this page was disconnected when it had the number `before`.
    std::string hello(std::uint64_t before) const;
    /// The line with branches and bookmarks; empty: not known.
    const std::string& timeline() const { return timeline_; }
    /// The line with surfaces in motion and bonds.
    std::string extras_line() const;
    std::uint64_t next_page() { return ++last_page_; }
    /// For one more page of this address.
    bool has_room(const std::string& address) const;
    void admit(const std::shared_ptr<PageSession>& page);
    /// Its WebSocket is open: it hears who has control.
    void entered(PageSession& page);
    void dismiss(std::uint64_t page, const Farewell& farewell);
    void connection_ended(HttpSession* session) { connections_.erase(session); }
    /// What the page wants has changed.
    void watch_changed();
    void call(PageSession& page, PageRequest&& request);
    void take(PageSession& page, const PageDesk& request, std::int64_t id);
    void count_sent(std::size_t bytes) { sent_bytes_.fetch_add(bytes, std::memory_order_relaxed); }
    void notice(std::string text);
    /// Somebody waits for the scene: it is fetched.
    void want_scene(std::function<void()> then);

    std::vector<std::string> take_notices();
    GatewayLoad load() const;

  private:
    void serve();
    void accept();
    void take_news();
    void send_scene();
    void send_lines(std::vector<Line>& lines);
    void send_states(const News& news);
    void send_exact();
    void begin_pictures();
    void send_pictures();
    void send_roles();
    std::string roles_line(const PageSession& page) const;
    bool make_room(const std::string& address);
    std::size_t pages_of(const std::string& address) const;
    void measure();
    void check_users();
    void note_refusal(const PageSession& page, const Error& error);

    GatewayOptions options_;
    Access access_;
    std::shared_ptr<boost::asio::ssl::context> tls_;
    std::int64_t users_ms_ = 0;  // when they were read last
    std::string users_problem_;  // why they could not be read then
    PageFiles files_;
    std::shared_ptr<Exchange> exchange_;
    std::set<HttpSession*> connections_;  // sessions take themselves out, the last ones when io_ ends
    ControlDesk desk_;
    boost::asio::io_context io_;
    boost::asio::ip::tcp::acceptor acceptor_;
    boost::asio::steady_timer clock_,
        late_;  // CPU time is read now and then; a view's last part may come late
    std::thread thread_;
    std::map<std::uint64_t, std::shared_ptr<PageSession>> pages_;
    std::uint64_t last_page_ = 0;
    std::deque<std::pair<std::uint64_t, Farewell>> farewells_;  // of the pages that were disconnected last
    std::vector<std::shared_ptr<std::function<void()>>> scene_waiters_;
    std::shared_ptr<const ShownScene> scene_;
    ViewStateCache order_log_;
    std::string timeline_;
    Inspector inspector_;
    std::optional<ShownVisuals> visuals_;        // of scene_
    std::unique_ptr<PictureRenderer> pictures_;  // made when the first page looks through a camera

    mutable std::mutex mutex_;
    std::vector<std::string> notices_;
    RateLimit notice_rate_;
    std::size_t notices_left_out_ = 0;
    std::atomic<std::uint64_t> sent_bytes_ = 0, cpu_ns_ = 0, page_count_ = 0;
};

std::int64_t steady_ms();

}  // namespace roboss
