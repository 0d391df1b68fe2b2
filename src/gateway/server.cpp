// Finding a port, and the token where one is needed.
#include "gateway/server.h"

#include "gateway/server_core_session.h"

namespace roboss {
namespace {

constexpr int kPortsTried = 50;

/// Without tokens on loopback; else one for each role up to `most`.
Access access_for(const ListenAddress& at, PageRole most) {
    if (is_loopback(at.address)) return Access(most);
    Access::Tokens tokens;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(most); ++i) tokens[i] = random_token();
    return Access(tokens);
}

}  // namespace

Result<std::unique_ptr<Server>> Server::open(const GatewayOptions& options,
                                             std::shared_ptr<Exchange> exchange) {
    Result<ListenAddress> address = parse_listen_address(options.listen);
    if (!address) return address.error();
    ListenAddress at = address.value();
    std::unique_ptr<Server> server(new Server());
    server->core_ = std::make_unique<ServerCore>(options, access_for(at, options.role), std::move(exchange));
    Result<> listening = server->core_->listen(at);
    for (int i = 1; !listening && options.next_port && at.port > 0 && at.port < 65'535 && i < kPortsTried;
         ++i) {
        ++at.port;
        listening = server->core_->listen(at);
    }
    if (!listening) return listening.error();
    const std::string host = at.address.find(':') == std::string::npos ? at.address : "[" + at.address + "]";
    const std::string page = "http://" + host + ":" + std::to_string(server->core_->port()) + "/";
    const auto url_for = [&](PageRole role) {
        const std::string& token = server->core_->access().token(role);
        return token.empty() ? page : page + "?token=" + token;
    };
    server->url_ = url_for(options.role);
    for (int i = static_cast<int>(options.role) - 1; i >= 0 && !is_loopback(at.address); --i)
        server->other_urls_.push_back(std::string("to ") + name_of(static_cast<PageRole>(i)) + ": " +
                                      url_for(static_cast<PageRole>(i)));
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
