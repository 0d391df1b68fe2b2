// Server: the gateway's thread. It listens, serves the page and the scene, and keeps every page up to date at
// the pace that the page bears.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "gateway/access.h"
#include "gateway/exchange.h"
#include "gateway/gateway.h"

namespace roboss {

class ServerCore;

class Server {
  public:
    static Result<std::unique_ptr<Server>> open(const GatewayOptions& wanted,
                                                std::shared_ptr<Exchange> exchange);
    ~Server();

    const std::string& url() const { return url_; }
    const std::vector<std::string>& other_urls() const { return other_urls_; }
    const std::string& fingerprint() const { return fingerprint_; }
    std::vector<std::string> take_notices();
    void say_farewell(const RunOver& over);
    GatewayLoad load() const;

  private:
    Server() = default;
    std::unique_ptr<ServerCore> core_;
    std::string url_, fingerprint_;
    std::vector<std::string> other_urls_;
};

}  // namespace roboss
