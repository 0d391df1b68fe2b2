// Gateway: serves the viewer's page to browsers (docs/viewer.md). Its HTTP and WebSocket server has a thread
// of its own; towards the run it is a guest that is advanced with the roles, watches what is committed, and
// gives orders as an ordinary Client. No header of this layer shows Boost, but those named *_session.h.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "core/result.h"
#include "gateway/roles.h"
#include "net/certificates.h"
#include "wire/message.h"

namespace roboss {

struct GatewayOptions {
    std::string listen = "8090";  // [ADDRESS:]PORT
    std::string page_folder;      // empty: where it was built or installed
    bool next_port = true;        // if the port is taken, one of those behind it
    std::string program = "roboss";
    bool framed = false;                    // pages of this computer (a notebook) may show it in a frame
    bool journal = false;                   // the run keeps one: pages offer to rewind
    PageRole role = PageRole::kAdminister;  // the greatest that a page gets
    /// Served over TLS with this certificate, behind which those between it and its authority may stand.
    /// Empty: plain on loopback, elsewhere with one that is made for this page.
    std::optional<KeyPair> certificate{};
    bool insecure = false;  // plain elsewhere, too, unless there is a certificate
    /// Returns the users who may open the page; called in the gateway's thread, once a second. Empty:
    /// everybody on loopback, elsewhere the holders of a token of this run.
    std::function<Result<std::vector<PageUser>>()> users{};
    /// A new address for the Bus, never used before.
    std::function<Address()> new_address;
};

struct GatewayLoad {
    std::uint64_t pages = 0, sent_bytes = 0;
    double cpu_s = 0;  // of the server's thread
};

class Gateway {
  public:
    /// Listens at once; an Error says why it cannot.
    static Result<std::unique_ptr<Gateway>> open(const GatewayOptions& options);
    ~Gateway();

    /// Where browsers find it, with the token if one is needed.
    const std::string& url() const;
    /// For pages of lower roles, with their tokens; none on loopback, or if users have tokens of their own.
    const std::vector<std::string>& other_urls() const;
    /// SHA-256 of the certificate, as browsers show it; empty: the page is not served over TLS.
    const std::string& fingerprint() const;
    /// The run's side: a turn. Never waits; costs nothing while nobody watches.
    void advance(Bus& bus);
    /// Refusals and such, one line each, since the last call.
    std::vector<std::string> take_notices();
    /// Why the run is over, if a reason was sent; empty: it is not over.
    const std::string& over() const;
    /// Says to all pages why the run is over (or the viewer ends), and closes them; takes a moment.
    void say_farewell(const RunOver& over);
    GatewayLoad load() const;

  private:
    struct Parts;
    explicit Gateway(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace roboss
