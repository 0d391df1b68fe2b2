// TLS 1.3 with certificates on both sides, apart from any socket: bytes in, bytes out. Who is at the other
// end is known when the handshake is over; a certificate that is not accepted does not end the session, so
// that the reason can be sent to the other end.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "net/certificates.h"

namespace roboss {

/// What a process shows, and by what it judges others.
struct Credentials {
    std::string authority;          ///< certificate of the authority, PEM
    KeyPair own;                    ///< signed by it
    std::set<std::string> revoked;  ///< serials of certificates that are not accepted any more
};

/// Credentials, read and checked once for all sessions of a process.
class TlsContext {
  public:
    /// An Error: a text is no certificate or key, or key and certificate do not belong together.
    static Result<std::shared_ptr<const TlsContext>> make(const Credentials& credentials);
    ~TlsContext();

  private:
    friend class TlsSession;
    struct Parts;
    explicit TlsContext(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

class TlsSession {
  public:
    /// `accepts`: the side that was called.
    TlsSession(std::shared_ptr<const TlsContext> context, bool accepts);
    ~TlsSession();

    /// Bytes from the network; appends what they say to `plain`. False: the session has failed.
    bool receive(std::span<const std::uint8_t> from_network, std::vector<std::uint8_t>& plain);
    /// Once established: appends the encrypted bytes to what output() gives. False: the session has failed.
    bool send(std::span<const std::uint8_t> plain);
    /// Moves what is to go to the network to the end of `bytes`.
    void take_output(std::vector<std::uint8_t>& bytes);

    bool established() const { return established_; }
    /// Why it failed.
    const std::string& failure() const { return failure_; }
    /// Once established: who is at the other end, if its certificate is one of ours.
    const Holder& peer() const { return peer_; }
    /// Once established: why the other end is not accepted; empty: it is.
    const std::string& objection() const { return objection_; }

  private:
    bool advance(std::vector<std::uint8_t>& plain);
    void judge();

    struct Parts;
    std::shared_ptr<const TlsContext> context_;
    std::unique_ptr<Parts> parts_;
    bool established_ = false;
    Holder peer_;
    std::string failure_, objection_;
};

}  // namespace roboss
