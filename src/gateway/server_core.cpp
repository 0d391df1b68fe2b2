// The gateway's thread: it takes news from the run's thread and sends them to pages.
#include <algorithm>
#include <boost/asio/post.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "client/control_text.h"
#include "core/thread_cpu.h"
#include "gateway/http_session.h"
#include "gateway/page_session.h"
#include "gateway/run_json.h"
#include "gateway/server_core_session.h"
#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

namespace asio = boost::asio;
using Json = nlohmann::ordered_json;
using tcp = asio::ip::tcp;

constexpr std::size_t kConnectionsMax = 64, kConnectionsOfOneMax = 48;  // before they are WebSockets
constexpr std::size_t kPagesMax = 16, kPagesOfOneMax = 12;              // of one address; loopback: all
constexpr double kNoticesASecond = 20;  // the rest is counted: the log is not theirs to fill
constexpr int kSendBytes = 256 << 10;   // what lies in a socket is old when it is read: not much of it
constexpr auto kLatePart = std::chrono::milliseconds(8);
constexpr auto kSceneWait = std::chrono::seconds(5);
constexpr std::int64_t kFarewell_ms = 300;
constexpr std::size_t kFarewellsMax = 64;
constexpr std::int64_t kUsersEvery_ms = 1'000;

std::string answer_line(std::int64_t id, bool done, const std::string& text) {
    return Json{{"type", "answer"}, {"id", id}, {"done", done}, {"text", text}}.dump();
}
std::string answer_line(std::int64_t id, const Error& error) {
    return Json{{"type", "answer"}, {"id", id}, {"done", false}, {"text", error.text()}, {"code", error.code}}
        .dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::int64_t steady_ms() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

ServerCore::ServerCore(const GatewayOptions& options, Access access, std::shared_ptr<asio::ssl::context> tls,
                       std::shared_ptr<Exchange> exchange)
    : options_(options),
      access_(std::move(access)),
      tls_(std::move(tls)),
      users_ms_(steady_ms()),
      files_(find_page_folder(options.page_folder)),
      exchange_(std::move(exchange)),
      io_(1),
      acceptor_(io_),
      clock_(io_),
      late_(io_),
      notice_rate_(kNoticesASecond) {}

ServerCore::~ServerCore() {
    stop();
}

Result<> ServerCore::listen(const ListenAddress& address) {
    boost::system::error_code error;
    const auto ip = asio::ip::make_address(address.address, error);
    if (error)
        return Error{"'" + address.address + "' is not an address of this computer",
                     "give an IPv4 or IPv6 address, for example 0.0.0.0 for all", "bad-address"};
    const tcp::endpoint endpoint(ip, address.port);
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (!error) return Ok{};
    boost::system::error_code ignored;
    acceptor_.close(ignored);
    return Error{"the viewer cannot listen at " + address.address + ":" + std::to_string(address.port) +
                     ": " + error.message(),
                 "give another port with --view, or disable the viewer with --headless", "cannot-listen"};
}

std::uint16_t ServerCore::port() const {
    boost::system::error_code error;
    return acceptor_.local_endpoint(error).port();
}

void ServerCore::start() {
    exchange_->set_bell([this] { asio::post(io_, [this] { take_news(); }); });
    accept();
    measure();
    thread_ = std::thread([this] { serve(); });
}

/// Nothing that a page or a file brings may end the run.
void ServerCore::serve() {
    for (;;) {
        try {
            io_.run();
            return;
        } catch (const std::exception& e) {
            notice(std::string("viewer: ") + e.what());
        }
    }
}

void ServerCore::say_farewell(const RunOver& over) {
    if (!thread_.joinable()) return;
    asio::post(io_, [this, text = over_line(over)] {
        for (const auto& [number, page] : std::map(pages_)) {
            page->send(text, false);
            page->leave();
        }
    });
    const std::int64_t until_ms = steady_ms() + kFarewell_ms;
    while (page_count_ > 0 && steady_ms() < until_ms)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

void ServerCore::stop() {
    if (!thread_.joinable()) return;
    exchange_->set_bell({});
    io_.stop();
    thread_.join();
    pictures_.reset();  // it may still ring: io_ does nothing any more
    pages_.clear();
}

void ServerCore::accept() {
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
        if (error == asio::error::operation_aborted) return;
        if (!error) {
            boost::system::error_code ignored;
            socket.set_option(tcp::no_delay(true), ignored);
            socket.set_option(asio::socket_base::send_buffer_size(kSendBytes), ignored);
            const auto session = std::make_shared<HttpSession>(std::move(socket), *this);
            if (make_room(session->peer())) {
                connections_.insert(session.get());
                session->start();
            } else {
                notice("viewer: a connection from " + session->peer() +
                       " is refused: too many are busy [too-many-connections]");
            }
        }
        accept();
    });
}

/// For one more connection from this address. Where there are too many, the one goes that has been idle for
/// longest: of this address if it has too many, else of the address that has the most.
bool ServerCore::make_room(const std::string& address) {
    std::map<std::string, std::size_t> counts;
    for (const HttpSession* session : connections_) ++counts[session->peer()];
    const bool one_has_too_many = counts[address] >= kConnectionsOfOneMax;
    if (!one_has_too_many && connections_.size() < kConnectionsMax) return true;
    HttpSession* idlest = nullptr;
    const auto goes_before = [&](const HttpSession& a, const HttpSession& b) {
        if (counts[a.peer()] != counts[b.peer()]) return counts[a.peer()] > counts[b.peer()];
        return *a.idle_since_ms() < *b.idle_since_ms();
    };
    for (HttpSession* session : connections_) {
        if (!session->idle_since_ms() || (one_has_too_many && session->peer() != address)) continue;
        if (idlest == nullptr || goes_before(*session, *idlest)) idlest = session;
    }
    if (idlest == nullptr) return false;
    connections_.erase(idlest);
    idlest->close();
    return true;
}

std::size_t ServerCore::pages_of(const std::string& address) const {
    std::size_t count = 0;
    for (const auto& [number, page] : pages_) count += page->peer() == address ? 1 : 0;
    return count;
}

bool ServerCore::has_room(const std::string& address) const {
    return pages_.size() < kPagesMax && (is_loopback(address) || pages_of(address) < kPagesOfOneMax);
}

void ServerCore::admit(const std::shared_ptr<PageSession>& page) {
    pages_[page->number()] = page;
    page_count_ = pages_.size();
}

void ServerCore::entered(PageSession& page) {
    const PageUser& user = page.user();
    desk_.enter({page.number(), page.peer(), user.role, user.name});
    if (!user.name.empty()) notice("viewer: " + page.title() + " is open; it may " + name_of(user.role));
    send_roles();
}

void ServerCore::dismiss(std::uint64_t page, const Farewell& farewell) {
    if (pages_.erase(page) == 0) return;
    if (!farewell.why.empty()) farewells_.emplace_back(page, farewell);
    if (farewells_.size() > kFarewellsMax) farewells_.pop_front();
    page_count_ = pages_.size();
    desk_.leave(page);
    send_roles();
    watch_changed();
}

void ServerCore::watch_changed() {
    WatchRequest request;
    double rate = 0;
    std::set<RobotId> robots;
    for (const auto& [number, page] : pages_) {
        if (!page->open()) continue;
        const PageWatch& watch = page->watch();
        request.anyone = true;
        request.contacts = request.contacts || watch.contacts;
        request.radio = request.radio || watch.radio;
        request.bounds = request.bounds || watch.bounds;
        request.groups = request.groups || watch.groups;
        request.profile = request.profile || watch.profile;
        rate = std::max(rate, watch.rate);
        robots.insert(watch.robots.begin(), watch.robots.end());
        for (const PictureWish& wish : watch.cameras) robots.insert(wish.robot);
        if (watch.numbers) robots.insert(watch.numbers->robot);
        request.cameras = request.cameras || !watch.cameras.empty();
    }
    request.anyone = request.anyone || !scene_waiters_.empty();
    request.robots.assign(robots.begin(), robots.end());
    if (rate > 0) request.interval_ms = static_cast<std::uint32_t>(std::max(1.0, 1000 / rate));
    exchange_->watch(request);
}

void ServerCore::call(PageSession& page, PageRequest&& request) {
    PageCall call{page.number(), request.id, ControlAction{}};
    PageRole needed = PageRole::kSteer;
    if (const auto* words = std::get_if<ControlArguments>(&request.what)) {
        Result<ControlAction> action = parse_control(words->words);
        if (!action) return page.send(answer_line(request.id, action.error()), false);
        needed = role_needed(action.value());
        call.what = std::move(action).value();
    } else {
        call.what = std::get<PageOrder>(std::move(request.what));
    }
    const Result<> may = desk_.act(page.number(), needed);
    send_roles();
    if (!may) {
        note_refusal(page, may.error());
        return page.send(answer_line(request.id, may.error()), false);
    }
    if (exchange_->call(std::move(call))) return;
    page.send(answer_line(request.id, {"too many requests at once", "wait for replies", "busy"}), false);
}

void ServerCore::take(PageSession& page, const PageDesk& request, std::int64_t id) {
    const bool asks = request.kind == PageDesk::Kind::kAsk;
    const Result<> done = asks ? desk_.ask(page.number(), id, steady_ms())
                          : request.kind == PageDesk::Kind::kYield
                              ? desk_.yield(page.number(), request.page)
                              : desk_.keep(page.number(), request.page.value_or(0));
    if (!done) note_refusal(page, done.error());
    if (!done) page.send(answer_line(id, done.error()), false);
    if (done && !asks) page.send(answer_line(id, true, "done"), false);
    send_roles();
}

/// That another page has control is no offence.
void ServerCore::note_refusal(const PageSession& page, const Error& error) {
    if (error.code == "not-permitted")
        notice("viewer: " + page.title() + " is refused: " + error.message + " [" + error.code + "]");
}

/// Tells pages what the desk has decided.
void ServerCore::send_roles() {
    for (const ControlDesk::Decision& d : desk_.take_decisions())
        if (const auto page = pages_.find(d.page); page != pages_.end())
            page->second->send(answer_line(d.id, d.granted, d.text), false);
    if (!desk_.take_changed()) return;
    for (const auto& [number, page] : std::map(pages_)) page->send(roles_line(*page), false);
}

std::string ServerCore::roles_line(const PageSession& page) const {
    const auto shown = [](const OpenPage& p) {
        return Json{{"page", p.number}, {"address", p.address}, {"user", p.user}, {"role", name_of(p.role)}};
    };
    Json line{{"type", "roles"}, {"page", page.number()}, {"role", name_of(page.user().role)}};
    line["holder"] = desk_.holder() == nullptr ? Json() : shown(*desk_.holder());
    line["asking"] = Json::array();
    for (const OpenPage& p : desk_.asking()) line["asking"].push_back(shown(p));
    return line.dump();
}

void ServerCore::want_scene(std::function<void()> then) {
    if (scene_) return then();  // should it be old, the page hears of the new one over its WebSocket
    auto waiter = std::make_shared<std::function<void()>>(std::move(then));
    auto timer = std::make_shared<asio::steady_timer>(io_, kSceneWait);
    scene_waiters_.push_back(waiter);
    watch_changed();
    timer->async_wait([this, waiter, timer](boost::system::error_code error) {
        if (error || std::erase(scene_waiters_, waiter) == 0) return;
        (*waiter)();
        watch_changed();
    });
}

std::string ServerCore::hello(std::uint64_t before) const {
    nlohmann::ordered_json hello{{"type", "hello"},
                                 {"version", viewer_protocol::kVersion},
                                 {"scene", scene_ ? scene_->number : 0},
                                 {"world", scene_ ? scene_->model->name : ""},
                                 {"journal", options_.journal},
                                 {"rate", viewer_protocol::kRateMax},
                                 {"program", options_.program}};
    for (const auto& [page, farewell] : farewells_)
        if (page == before) hello["dropped"] = {{"why", farewell.why}, {"code", farewell.code}};
    return hello.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string ServerCore::extras_line() const {
    return roboss::extras_line(order_log_.extras(), order_log_.tick(), scene_ ? scene_->number : 0);
}

void ServerCore::take_news() {
    News news = exchange_->take_news();
    if (news.scene) {
        scene_ = news.scene;
        visuals_.reset();
        send_scene();
    }
    if (news.visuals && scene_ && news.visuals->scene == scene_->number) visuals_ = news.visuals;
    send_states(news);
    for (const StateBlock& block : news.exact) inspector_.take(block);
    if (!news.exact.empty()) send_exact(), begin_pictures();
    send_lines(news.lines);
}

void ServerCore::send_scene() {
    order_log_.begin(scene_);
    inspector_.begin(scene_);
    for (const auto& waiter : std::exchange(scene_waiters_, {})) (*waiter)();
    const std::string text = nlohmann::json{{"type", "scene"}, {"scene", scene_->number}}.dump();
    for (const auto& [number, page] : std::map(pages_)) {
        page->begin_scene();
        if (!page->greet()) page->send(text, false);
    }
    watch_changed();
}

/// Views of several Simulators come in parts: a State waits a moment for the last one.
void ServerCore::send_states(const News& news) {
    bool taken = false;
    for (const ViewStates& views : news.views) taken = order_log_.take(views, steady_ms()) || taken;
    if (!taken) return;
    const auto show = [this] {
        for (const auto& [number, page] : std::map(pages_)) page->show_state();
    };
    if (order_log_.complete()) {
        late_.cancel();
        return show();
    }
    late_.expires_after(kLatePart);
    late_.async_wait([show](boost::system::error_code error) {
        if (!error) show();
    });
}

void ServerCore::send_exact() {
    std::map<RobotId, std::string> robots;
    std::string contacts, radio;
    for (const auto& [number, page] : std::map(pages_)) {
        for (const RobotId robot : page->watch().robots) {
            if (!inspector_.shows(robot)) continue;
            std::string& text = robots[robot];
            if (text.empty()) text = inspector_.robot(robot);
            page->send(text, true);
        }
        if (const auto& wish = page->watch().numbers; wish && inspector_.shows(wish->robot))
            if (std::string text = inspector_.numbers(*wish); !text.empty())
                page->send(std::move(text), true);
        if (!inspector_.complete()) continue;
        if (page->watch().contacts) {
            if (contacts.empty()) contacts = inspector_.contacts();
            page->send(contacts, true);
        }
        if (page->watch().radio) {
            if (radio.empty()) radio = inspector_.radio();
            page->send(radio, true);
        }
    }
}

/// Of all that pages look at through cameras, each once, in the largest size that one of them wants.
void ServerCore::begin_pictures() {
    if (!visuals_ || !inspector_.complete() || (pictures_ && !pictures_->is_free())) return;
    std::vector<PictureWish> wishes;
    for (const auto& [number, page] : pages_)
        for (const PictureWish& wish : page->watch().cameras) {
            const auto same = std::ranges::find(wishes, wish.key(), &PictureWish::key);
            if (same == wishes.end())
                wishes.push_back(wish);
            else if (same->columns != 0 && (wish.columns == 0 || wish.columns > same->columns))
                same->columns = wish.columns;
        }
    if (wishes.empty()) return;
    if (!pictures_)
        pictures_ =
            std::make_unique<PictureRenderer>([this] { asio::post(io_, [this] { send_pictures(); }); });
    pictures_->begin(
        {scene_, visuals_->bytes, inspector_.all_states(), inspector_.tick(), std::move(wishes)});
}

void ServerCore::send_pictures() {
    for (const PictureNews& news : pictures_->take()) {
        if (!scene_ || news.scene != scene_->number) continue;
        for (const auto& [number, page] : std::map(pages_)) {
            const std::vector<PictureWish>& wishes = page->watch().cameras;
            if (!page->open() || wishes.empty()) continue;
            if (!news.why.empty())
                page->send(news.why, true);
            else if (std::ranges::find(wishes, news.wish.key(), &PictureWish::key) != wishes.end())
                page->show_picture(news.wish, news.message);
        }
    }
}

void ServerCore::send_lines(std::vector<Line>& lines) {
    for (Line& line : lines) {
        std::string text;  // made for the first page that gets it
        if (line.to == Line::To::kTimeline) text = timeline_ = line.make();
        for (const auto& [number, page] : std::map(pages_)) {
            const PageWatch& watch = page->watch();
            const bool gets_it = line.to == Line::To::kPage      ? number == line.page
                                 : line.to == Line::To::kGroups  ? watch.groups
                                 : line.to == Line::To::kBounds  ? watch.bounds
                                 : line.to == Line::To::kProfile ? watch.profile
                                                                 : true;
            if (!gets_it) continue;
            if (text.empty()) text = line.make();
            if (text.empty()) break;
            std::string sent = text;
            if (line.to == Line::To::kStatus && sent.size() > 2) {
                sent.pop_back();
                sent += ",\"viewers\":" + std::to_string(pages_.size()) +
                        ",\"sent_bytes\":" + std::to_string(page->sent_bytes()) + "}";
            }
            page->send(std::move(sent), line.may_miss);
            if (!line.preview.empty()) page->show_preview(std::move(line.preview));
        }
    }
}

void ServerCore::notice(std::string text) {
    const std::scoped_lock lock(mutex_);
    if (notice_rate_.take(steady_ms())) return notices_.push_back(std::move(text));
    ++notices_left_out_;
}

std::vector<std::string> ServerCore::take_notices() {
    const std::scoped_lock lock(mutex_);
    const bool may_report = notices_left_out_ > 0 && notice_rate_.take(steady_ms());
    if (const std::size_t n = may_report ? std::exchange(notices_left_out_, 0) : 0; n > 0)
        notices_.push_back("viewer: " + std::to_string(n) +
                           " more such messages are left out [rate-limited]");
    return std::exchange(notices_, {});
}

/// CPU time of this thread, for those who ask from another.
void ServerCore::measure() {
    if (thread_.joinable()) cpu_ns_ = thread_cpu_ns();
    clock_.expires_after(std::chrono::milliseconds(100));
    clock_.async_wait([this](boost::system::error_code error) {
        if (error) return;
        check_users();
        desk_.advance(steady_ms());
        send_roles();
        measure();
    });
}

/// Users come and go while the run lasts. As long as they cannot be read, they stay as they were.
void ServerCore::check_users() {
    if (!options_.users || steady_ms() - users_ms_ < kUsersEvery_ms) return;
    users_ms_ = steady_ms();
    Result<std::vector<PageUser>> users = options_.users();
    const std::string problem = users ? "" : users.error().text();
    if (std::exchange(users_problem_, problem) != problem && !users)
        notice("viewer: the users of the page stay as they were: " + problem);
    if (!users || !access_.set_users(std::move(users).value())) return;
    for (const auto& [number, page] : std::map(pages_))
        if (const std::string why = access_.withdrawal(page->user()); !why.empty())
            page->expel(why, "revoked");
}

GatewayLoad ServerCore::load() const {
    return {page_count_, sent_bytes_, 1e-9 * static_cast<double>(cpu_ns_)};
}

}  // namespace roboss
