// HttpSession: one connection before it is a WebSocket: the page's files, the scene, its meshes and pictures.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <memory>
#include <optional>
#include <string>

#include "gateway/page_stream_session.h"
#include "gateway/roles.h"

namespace roboss {

class ServerCore;

class HttpSession : public std::enable_shared_from_this<HttpSession> {
  public:
    HttpSession(boost::asio::ip::tcp::socket&& socket, ServerCore& core);
    ~HttpSession();
    void start();
    const std::string& peer() const { return peer_; }
    /// Since when it waits for a request, ms; nothing: one is being answered.
    std::optional<std::int64_t> idle_since_ms() const { return idle_since_ms_; }
    /// Closes it; no more is read.
    void close() { stream_.close(); }

  private:
    using Request = boost::beast::http::request<boost::beast::http::empty_body>;
    struct Answer {
        boost::beast::http::status status = boost::beast::http::status::ok;
        std::string type = "text/plain; charset=utf-8";
        std::string body;
        std::string kept_token{};    // goes into a cookie
        bool never_changes = false;  // what is at this address
        std::string location{};      // where it is instead
    };

    void shake_hands();
    void read();
    void serve();
    void upgrade(const PageUser& user);
    void lead_to_tls();
    void serve_scene();
    Answer answer_for(std::string_view path) const;
    Answer mesh(std::string_view number) const;
    Answer texture(std::string_view hash) const;
    void send(Answer answer);
    void refuse(boost::beast::http::status status, const std::string& why);

    PageStream stream_;
    ServerCore& core_;
    std::string peer_;
    boost::beast::flat_buffer buffer_;
    std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
    Request request_;
    std::optional<std::int64_t> idle_since_ms_;
};

}  // namespace roboss
