// Finding a port, and the token where one is needed.
#include "gateway/server.h"

#include "gateway/server_core_session.h"

namespace roboss {
namespace {

constexpr int kPortsTried = 50;

}  // namespace

Result<std::unique_ptr<Server>> Server::open(const GatewayOptions& options,
                                             std::shared_ptr<Exchange> exchange) {
    Result<ListenAddress> address = parse_listen_address(options.listen);
    if (!address) return address.error();
    ListenAddress at = address.value();
    const std::string token = is_loopback(at.address) ? "" : random_token();
    std::unique_ptr<Server> server(new Server());
    server->core_ = std::make_unique<ServerCore>(options, token, std::move(exchange));
    Result<> listening = server->core_->listen(at);
    for (int i = 1; !listening && options.next_port && at.port > 0 && at.port < 65'535 && i < kPortsTried;
         ++i) {
        ++at.port;
        listening = server->core_->listen(at);
    }
    if (!listening) return listening.error();
    const std::string host = at.address.find(':') == std::string::npos ? at.address : "[" + at.address + "]";
    server->url_ = "http://" + host + ":" + std::to_string(server->core_->port()) + "/";
    if (!token.empty()) server->url_ += "?token=" + token;
    server->core_->start();
    return server;
}

Server::~Server() = default;

std::vector<std::string> Server::take_notices() {
    return core_->take_notices();
}

GatewayLoad Server::load() const {
    return core_->load();
}

}  // namespace roboss
