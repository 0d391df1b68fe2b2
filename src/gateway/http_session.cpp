// Requests, and the headers that keep a browser on its guard.
#include "gateway/http_session.h"

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>

#include "core/hash.h"
#include "core/markup.h"
#include "gateway/page_session.h"
#include "gateway/server_core_session.h"
#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

constexpr auto kPatience = std::chrono::seconds(20);
constexpr std::uint32_t kHeaderBytesMax = 16u << 10;

const char* const kContentSecurityPolicy =
    "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "media-src 'self' blob:; worker-src 'self' blob:; connect-src 'self'; object-src 'none'; base-uri "
    "'none'; "
    "form-action 'none'; frame-ancestors ";
/// Notebooks in a browser on this computer, and in an editor.
const char* const kLocalFrames =
    "http://localhost:* http://127.0.0.1:* https://localhost:* https://127.0.0.1:* vscode-webview:";

std::string_view view_of(beast::string_view text) {
    return {text.data(), text.size()};
}

std::string_view path_of(std::string_view target) {
    return target.substr(0, target.find('?'));
}

std::string name_of(const asio::ip::tcp::socket& socket) {
    beast::error_code error;
    const auto endpoint = socket.remote_endpoint(error);
    return error ? "someone" : endpoint.address().to_string();
}

std::string refusal_page(std::string_view why) {
    return "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>RoBOSS: refused</title>"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><style>"
           ":root{color-scheme:light dark}body{font:16px/1.5 system-ui,sans-serif;max-width:38rem;"
           "margin:12vh auto;padding:0 1rem}</style><h1>The viewer refused this request</h1><p>Reason: " +
           escaped(why) +
           "</p><p>Open the address that the run printed at its start (<code>roboss: viewer at ...</code>), "
           "with the token in it, or with the token that you were given. Each start of a run makes new "
           "tokens, but not for users who have their own. On the computer of the run, use "
           "<code>localhost</code> or <code>127.0.0.1</code>.</p></html>\n";
}

}  // namespace

HttpSession::HttpSession(asio::ip::tcp::socket&& socket, ServerCore& core)
    : stream_(std::move(socket)), core_(core), peer_(name_of(stream_.tcp().socket())) {}

HttpSession::~HttpSession() {
    core_.connection_ended(this);
}

void HttpSession::start() {
    if (core_.tls() == nullptr) return read();
    stream_.tcp().expires_after(kPatience);
    idle_since_ms_ = steady_ms();
    beast::async_detect_ssl(stream_.tcp(), buffer_,
                            [self = shared_from_this()](beast::error_code error, bool speaks_tls) {
                                if (error) return self->close();
                                speaks_tls ? self->shake_hands() : self->read();
                            });
}

void HttpSession::shake_hands() {
    stream_.shake_hands(*core_.tls(), buffer_, [self = shared_from_this()](beast::error_code error) {
        if (!error) return self->read();
        self->close();
        if (error != asio::error::operation_aborted && error != beast::error::timeout)
            self->core_.notice("viewer: a TLS handshake with " + self->peer_ + " failed: " + error.message() +
                               " [tls-handshake]");
    });
}

void HttpSession::read() {
    parser_.emplace();
    parser_->header_limit(kHeaderBytesMax);
    parser_->body_limit(0);
    stream_.tcp().expires_after(kPatience);
    idle_since_ms_ = steady_ms();
    http::async_read(
        stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (error == http::error::end_of_stream || error == asio::error::operation_aborted ||
                error == beast::error::timeout || error == asio::error::connection_reset ||
                error == asio::ssl::error::stream_truncated || error == asio::error::eof)
                return self->stream_.close();
            if (error) {
                self->request_ = {};
                self->request_.version(11);
                return self->refuse(http::status::bad_request, "malformed request: " + error.message());
            }
            self->request_ = self->parser_->release();
            self->idle_since_ms_.reset();
            self->serve();
        });
}

void HttpSession::serve() {
    if (core_.tls() != nullptr && !stream_.encrypted()) return lead_to_tls();
    const std::string_view path = path_of(view_of(request_.target()));
    const bool socket = path == "/ws";
    const Visitor visitor{view_of(request_[http::field::host]),
                          view_of(request_[http::field::origin]),
                          view_of(request_.target()),
                          view_of(request_[http::field::cookie]),
                          socket && beast::websocket::is_upgrade(request_),
                          request_.count(http::field::host),
                          request_.count(http::field::origin),
                          stream_.encrypted()};
    if (const std::string refusal = core_.access().refusal(visitor); !refusal.empty())
        return refuse(http::status::forbidden, refusal);
    if (request_.method() != http::verb::get && request_.method() != http::verb::head)
        return refuse(http::status::method_not_allowed, "only GET and HEAD are allowed");
    if (socket) return upgrade(core_.access().user_of(visitor).value_or(PageUser{}));
    if (path == "/scene") return serve_scene();
    Answer answer = answer_for(path);
    answer.kept_token = core_.access().named_token(visitor);
    send(std::move(answer));
}

void HttpSession::upgrade(const PageUser& user) {
    if (!core_.has_room(peer_))
        return refuse(http::status::service_unavailable,
                      "too many pages are open; close one of them [too-many-pages]");
    if (!beast::websocket::is_upgrade(request_))
        return refuse(http::status::upgrade_required, "/ws needs a WebSocket upgrade");
    http::token_list subprotocols(request_[http::field::sec_websocket_protocol]);
    if (!subprotocols.exists(viewer_protocol::kSubprotocol))
        return refuse(http::status::bad_request,
                      std::string("the WebSocket does not offer the subprotocol ") +
                          viewer_protocol::kSubprotocol + " [no-subprotocol]");
    auto page = std::make_shared<PageSession>(std::move(stream_), core_, core_.next_page(), peer_, user);
    core_.admit(page);
    page->start(request_);
}

/// Nothing of the run is said without TLS, but where it is.
void HttpSession::lead_to_tls() {
    const std::string_view host = view_of(request_[http::field::host]), target = view_of(request_.target());
    core_.notice("viewer: a request from " + peer_ + " came without TLS [no-tls]");
    request_.keep_alive(false);
    Answer answer;
    answer.status = http::status::bad_request;
    answer.body = "This page is served over TLS: its address begins with https://.\n";
    if (request_.count(http::field::host) == 1 && !host.empty() && target.starts_with('/')) {
        answer.status = http::status::temporary_redirect;
        answer.location = "https://" + std::string(host) + std::string(target);
    }
    send(std::move(answer));
}

/// The scene may have to be fetched first.
void HttpSession::serve_scene() {
    core_.want_scene([self = shared_from_this()] {
        const auto& scene = self->core_.scene();
        if (!scene)
            return self->send({http::status::service_unavailable, "text/plain; charset=utf-8",
                               "the run does not reply yet\n"});
        self->send({http::status::ok, "application/json", numbered(scene->file, scene->number)});
    });
}

HttpSession::Answer HttpSession::mesh(std::string_view number) const {
    std::size_t n = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), n);
    const auto& scene = core_.scene();
    if (error != std::errc() || end != number.data() + number.size() || !scene ||
        n >= scene->file.meshes.size())
        return {http::status::not_found, "text/plain; charset=utf-8", "no such mesh\n"};
    const std::vector<std::uint8_t>& bytes = scene->file.meshes[n];
    return {http::status::ok, "application/octet-stream", std::string(bytes.begin(), bytes.end())};
}

/// Only pictures that the scene has, by the hash of their bytes: no name of a file comes from outside.
HttpSession::Answer HttpSession::texture(std::string_view hash) const {
    if (const auto& scene = core_.scene())
        for (const TextureFile& t : scene->file.textures)
            if (to_hex(t.hash) == hash)
                return {http::status::ok,
                        mime_type(t.kind),
                        std::string(t.bytes.begin(), t.bytes.end()),
                        {},
                        true};
    return {http::status::not_found, "text/plain; charset=utf-8", "no such picture\n"};
}

HttpSession::Answer HttpSession::answer_for(std::string_view path) const {
    constexpr std::string_view kMesh = "/mesh/", kTexture = "/texture/";
    if (path.starts_with(kMesh)) return mesh(path.substr(kMesh.size()));
    if (path.starts_with(kTexture)) return texture(path.substr(kTexture.size()));
    std::optional<PageFile> file = core_.files().find(path);
    if (!file) return {http::status::not_found, "text/plain; charset=utf-8", "no such file\n"};
    return {http::status::ok, file->type, std::move(file->content)};
}

void HttpSession::refuse(http::status status, const std::string& why) {
    core_.notice("viewer: a request from " + peer_ + " is refused: " + why);
    request_.keep_alive(false);
    // Somebody who opened a wrong address reads this, not a program.
    if (status == http::status::forbidden && path_of(view_of(request_.target())) == "/")
        return send({status, "text/html; charset=utf-8", refusal_page(why)});
    send({status, "text/plain; charset=utf-8", "refused: " + why + "\n"});
}

void HttpSession::send(Answer answer) {
    auto response = std::make_shared<http::response<http::string_body>>(answer.status, request_.version());
    response->set(http::field::server, "roboss");
    response->set(http::field::content_type, answer.type);
    response->set(http::field::cache_control,
                  answer.never_changes ? "private, max-age=86400, immutable" : "no-cache");
    response->set("Content-Security-Policy",
                  std::string(kContentSecurityPolicy) + (core_.framed() ? kLocalFrames : "'none'"));
    response->set("X-Content-Type-Options", "nosniff");
    response->set("Referrer-Policy", "no-referrer");
    response->set("Cross-Origin-Resource-Policy", "same-origin");
    if (!answer.kept_token.empty())
        response->set(http::field::set_cookie, "roboss_token=" + answer.kept_token +
                                                   "; HttpOnly; SameSite=Strict; Path=/" +
                                                   (stream_.encrypted() ? "; Secure" : ""));
    if (!answer.location.empty()) response->set(http::field::location, answer.location);
    response->body() = std::move(answer.body);
    response->prepare_payload();
    if (request_.method() == http::verb::head) response->body().clear();
    response->keep_alive(request_.keep_alive());
    stream_.tcp().expires_after(kPatience);
    http::async_write(stream_, *response,
                      [self = shared_from_this(), response](beast::error_code error, std::size_t bytes) {
                          self->core_.count_sent(bytes);
                          if (error) return self->stream_.close();
                          if (response->keep_alive()) return self->read();
                          self->idle_since_ms_ = steady_ms();
                          self->stream_.finish(self);
                      });
}

}  // namespace roboss
