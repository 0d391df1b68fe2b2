// TlsTunnel: the TLS of a browser. What connects to it speaks to a gateway through TLS, so that all that
// tests do with a plain page they can do with an encrypted one.
#pragma once

#include <memory>
#include <string>

#include "browser.h"

namespace roboss::test {

struct TunnelOptions {
    std::string trusted;  // certificate, PEM: no other is accepted
    int version = 0;      // of TLS, as OpenSSL numbers them: this and no other; 0: any
};

class TlsTunnel {
  public:
    TlsTunnel(const ViewerUrl& gateway, const TunnelOptions& options);
    ~TlsTunnel();

    /// Its own end, with this token.
    ViewerUrl url(const std::string& token = {}) const;
    /// Why the last handshake failed; empty: none has.
    std::string failure() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace roboss::test
