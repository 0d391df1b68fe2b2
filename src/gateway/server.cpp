// Finding a port, the certificate, and the tokens where some are needed.
#include "gateway/server.h"

#include <algorithm>

#include "gateway/page_stream_session.h"
#include "gateway/server_core_session.h"
#include "net/run_keys.h"

namespace roboss {
namespace {

constexpr int kPortsTried = 50;

/// The users who may come in, and the tokens of this run: one for each role, from the least on; none where
/// none is needed.
struct Door {
    Access access;
    std::vector<std::string> tokens;
};

Result<Door> door_for(const ListenAddress& at, const GatewayOptions& options) {
    if (options.users) {
        Result<std::vector<PageUser>> users = options.users();
        if (!users) return users.error();
        return Door{Access(std::move(users).value()), {}};
    }
    if (is_loopback(at.address)) return Door{Access(options.role), {}};
    std::vector<PageUser> holders;
    std::vector<std::string> tokens;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(options.role); ++i) {
        tokens.push_back(random_token());
        holders.push_back({"", static_cast<PageRole>(i), token_digest(tokens.back())});
    }
    return Door{Access(std::move(holders)), std::move(tokens)};
}

/// No user gets more than the options allow.
GatewayOptions with_users_limited(GatewayOptions options) {
    if (!options.users) return options;
    options.users = [read = options.users, most = options.role]() -> Result<std::vector<PageUser>> {
        Result<std::vector<PageUser>> users = read();
        if (users)
            for (PageUser& user : users.value()) user.role = std::min(user.role, most);
        return users;
    };
    return options;
}

/// TLS with the certificate given, or with one that is made here if others than this computer reach the page;
/// null: it is plain.
Result<std::shared_ptr<boost::asio::ssl::context>> tls_for(const ListenAddress& at,
                                                           const GatewayOptions& options) {
    if (options.certificate) return tls_context(*options.certificate);
    if (options.insecure || is_loopback(at.address)) return std::shared_ptr<boost::asio::ssl::context>();
    const Result<KeyPair> made = new_page_keys(at.address);
    if (!made) return made.error();
    return tls_context(made.value());
}

}  // namespace

Result<std::unique_ptr<Server>> Server::open(const GatewayOptions& wanted,
                                             std::shared_ptr<Exchange> exchange) {
    const GatewayOptions options = with_users_limited(wanted);
    Result<ListenAddress> address = parse_listen_address(options.listen);
    if (!address) return address.error();
    ListenAddress at = address.value();
    const Result<std::shared_ptr<boost::asio::ssl::context>> encryption = tls_for(at, options);
    if (!encryption) return encryption.error();
    const std::shared_ptr<boost::asio::ssl::context>& tls = encryption.value();
    Result<Door> door = door_for(at, options);
    if (!door) return door.error();
    std::unique_ptr<Server> server(new Server());
    if (tls) server->fingerprint_ = fingerprint_of(*tls);
    server->core_ = std::make_unique<ServerCore>(options, door.value().access, tls, std::move(exchange));
    Result<> listening = server->core_->listen(at);
    for (int i = 1; !listening && options.next_port && at.port > 0 && at.port < 65'535 && i < kPortsTried;
         ++i) {
        ++at.port;
        listening = server->core_->listen(at);
    }
    if (!listening) return listening.error();
    const std::string host = at.address.find(':') == std::string::npos ? at.address : "[" + at.address + "]";
    const std::string page =
        (tls ? "https://" : "http://") + host + ":" + std::to_string(server->core_->port()) + "/";
    const std::vector<std::string>& tokens = door.value().tokens;
    server->url_ = tokens.empty() ? page : page + "?token=" + tokens.back();
    for (std::size_t i = tokens.empty() ? 0 : tokens.size() - 1; i-- > 0;)
        server->other_urls_.push_back(std::string("to ") + name_of(static_cast<PageRole>(i)) + ": " + page +
                                      "?token=" + tokens[i]);
    if (!tls && !is_loopback(at.address))
        server->core_->notice(
            "viewer: the page is not encrypted: who is between it and a browser can read its "
            "tokens and use them [insecure]");
    server->core_->start();
    return server;
}

Server::~Server() = default;

void Server::say_farewell(const RunOver& over) {
    core_->say_farewell(over);
}

std::vector<std::string> Server::take_notices() {
    return core_->take_notices();
}

GatewayLoad Server::load() const {
    return core_->load();
}

}  // namespace roboss
