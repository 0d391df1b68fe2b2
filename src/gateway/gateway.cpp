// The two sides and what lies between them.
#include "gateway/gateway.h"

#include "gateway/run_watcher.h"
#include "gateway/server.h"

namespace roboss {

struct Gateway::Parts {
    std::shared_ptr<Exchange> exchange;
    std::unique_ptr<Server> server;
    RunWatcher watcher;
};

Result<std::unique_ptr<Gateway>> Gateway::open(const GatewayOptions& options) {
    auto exchange = std::make_shared<Exchange>();
    Result<std::unique_ptr<Server>> server = Server::open(options, exchange);
    if (!server) return server.error();
    return std::unique_ptr<Gateway>(new Gateway(std::make_unique<Parts>(
        Parts{exchange, std::move(server).value(), RunWatcher(exchange, options.new_address)})));
}

Gateway::Gateway(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Gateway::~Gateway() = default;

const std::string& Gateway::url() const {
    return parts_->server->url();
}

const std::vector<std::string>& Gateway::other_urls() const {
    return parts_->server->other_urls();
}

const std::string& Gateway::fingerprint() const {
    return parts_->server->fingerprint();
}

void Gateway::advance(Bus& bus) {
    parts_->watcher.advance(bus);
}

const std::string& Gateway::over() const {
    return parts_->watcher.over();
}

std::vector<std::string> Gateway::take_notices() {
    std::vector<std::string> notices = parts_->server->take_notices();
    for (std::string& line : parts_->watcher.take_notices()) notices.push_back("viewer: " + std::move(line));
    return notices;
}

void Gateway::say_farewell(const RunOver& over) {
    parts_->server->say_farewell(over);
}

GatewayLoad Gateway::load() const {
    return parts_->server->load();
}

}  // namespace roboss
