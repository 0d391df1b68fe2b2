// OpenSSL's SSL functions over buffers in memory.
#include "net/tls.h"

#include <array>

#include "net/openssl.h"

namespace roboss {

using namespace openssl;

struct TlsContext::Parts {
    Context ssl;
    std::set<std::string> revoked;
};

struct TlsSession::Parts {
    Session ssl;
    BIO *in = nullptr, *out = nullptr;  // of the session
};

namespace {

constexpr std::size_t kRecord = 16'384;  // plain bytes of a TLS record

/// The verification result stays with the session; the handshake goes through, so that the reason can be
/// sent.
int accept_for_now(int, X509_STORE_CTX*) {
    return 1;
}

/// Complete sentences for what people meet; OpenSSL's words for the rest.
std::string words_for(long result, const std::string& who) {
    switch (result) {
        case X509_V_ERR_CERT_HAS_EXPIRED:
            return "the certificate of " + who + " has expired";
        case X509_V_ERR_CERT_NOT_YET_VALID:
            return "the certificate of " + who + " is not valid yet (check the clocks)";
        case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
        case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
        case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
        case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
        case X509_V_ERR_CERT_SIGNATURE_FAILURE:
            return "the certificate of " + who + " was not made by the authority of this run";
        default:
            return "the certificate of " + who + " is not accepted (" +
                   X509_verify_cert_error_string(result) + ")";
    }
}

}  // namespace

TlsContext::TlsContext(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
TlsContext::~TlsContext() = default;

Result<std::shared_ptr<const TlsContext>> TlsContext::make(const Credentials& credentials) {
    const auto wrong = [](const std::string& what) {
        return Error{what + ": " + take_error(), "make keys with `roboss keys`", "bad-keys"};
    };
    const Certificate authority = certificate_of(credentials.authority);
    if (!authority) return wrong("the authority's certificate cannot be read");
    const Certificate own = certificate_of(credentials.own.certificate);
    if (!own) return wrong("the certificate of this process cannot be read");
    const Key key = key_of(credentials.own.key);
    if (!key) return wrong("the key of this process cannot be read");
    auto parts = std::make_unique<Parts>();
    parts->ssl.reset(SSL_CTX_new(TLS_method()));
    parts->revoked = credentials.revoked;
    SSL_CTX* ssl = parts->ssl.get();
    if (ssl == nullptr) return wrong("TLS is not available");
    SSL_CTX_set_min_proto_version(ssl, TLS1_3_VERSION);
    SSL_CTX_set_num_tickets(ssl, 0);
    SSL_CTX_set_session_cache_mode(ssl, SSL_SESS_CACHE_OFF);
    SSL_CTX_set_verify(ssl, SSL_VERIFY_PEER, &accept_for_now);
    if (SSL_CTX_use_certificate(ssl, own.get()) != 1 || SSL_CTX_use_PrivateKey(ssl, key.get()) != 1 ||
        SSL_CTX_check_private_key(ssl) != 1)
        return wrong("the key of this process does not belong to its certificate");
    if (X509_STORE_add_cert(SSL_CTX_get_cert_store(ssl), authority.get()) != 1)
        return wrong("the authority's certificate cannot be used");
    return std::shared_ptr<const TlsContext>(new TlsContext(std::move(parts)));
}

TlsSession::TlsSession(std::shared_ptr<const TlsContext> context, bool accepts)
    : context_(std::move(context)), parts_(std::make_unique<Parts>()) {
    parts_->ssl.reset(SSL_new(context_->parts_->ssl.get()));
    parts_->in = BIO_new(BIO_s_mem());
    parts_->out = BIO_new(BIO_s_mem());
    ROBOSS_CHECK(parts_->ssl && parts_->in && parts_->out, "OpenSSL has no memory for a session");
    SSL_set_bio(parts_->ssl.get(), parts_->in, parts_->out);
    if (accepts)
        SSL_set_accept_state(parts_->ssl.get());
    else
        SSL_set_connect_state(parts_->ssl.get());
    std::vector<std::uint8_t> none;
    advance(none);  // a caller speaks first
}

TlsSession::~TlsSession() = default;

bool TlsSession::receive(std::span<const std::uint8_t> from_network, std::vector<std::uint8_t>& plain) {
    if (!failure_.empty()) return false;
    if (!from_network.empty())
        BIO_write(parts_->in, from_network.data(), static_cast<int>(from_network.size()));
    return advance(plain);
}

bool TlsSession::advance(std::vector<std::uint8_t>& plain) {
    SSL* ssl = parts_->ssl.get();
    const auto fail_unless_waiting = [&](int result) {
        const int reason = SSL_get_error(ssl, result);
        if (reason == SSL_ERROR_WANT_READ || reason == SSL_ERROR_WANT_WRITE) return true;
        failure_ = reason == SSL_ERROR_ZERO_RETURN ? "the other end has closed the connection"
                                                   : "TLS: " + take_error();
        return false;
    };
    ERR_clear_error();
    if (!established_) {
        const int done = SSL_do_handshake(ssl);
        if (done != 1) return fail_unless_waiting(done);
        established_ = true;
        judge();
        ERR_clear_error();  // SSL_get_error() would take those of a wrong signature for its own
    }
    for (;;) {
        const std::size_t at = plain.size();
        plain.resize(at + kRecord);
        std::size_t bytes = 0;
        const int result = SSL_read_ex(ssl, plain.data() + at, kRecord, &bytes);
        plain.resize(at + bytes);
        if (result != 1) return fail_unless_waiting(result);
    }
}

void TlsSession::judge() {
    const Certificate theirs(SSL_get1_peer_certificate(parts_->ssl.get()));
    if (!theirs) {
        objection_ = "the other end has no certificate";
        return;
    }
    const Result<Holder> holder = openssl::holder_of(theirs.get());
    if (holder) peer_ = holder.value();
    const std::string who = holder ? "'" + peer_.name + "'" : "the other end";
    if (const long result = SSL_get_verify_result(parts_->ssl.get()); result != X509_V_OK)
        objection_ = words_for(result, who);
    else if (!holder)
        objection_ = holder.error().message;
    else if (context_->parts_->revoked.contains(peer_.serial))
        objection_ = "the certificate of " + who + " has been revoked";
}

bool TlsSession::send(std::span<const std::uint8_t> plain) {
    if (!failure_.empty() || !established_) return false;
    ERR_clear_error();
    std::size_t written = 0;
    if (plain.empty() || SSL_write_ex(parts_->ssl.get(), plain.data(), plain.size(), &written) == 1)
        return true;
    failure_ = "TLS: " + take_error();
    return false;
}

void TlsSession::take_output(std::vector<std::uint8_t>& bytes) {
    char* data = nullptr;
    const long waiting = BIO_get_mem_data(parts_->out, &data);
    if (waiting <= 0) return;
    bytes.insert(bytes.end(), data, data + waiting);
    BIO_reset(parts_->out);
}

}  // namespace roboss
