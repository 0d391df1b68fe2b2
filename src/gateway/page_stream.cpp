// Contexts of TLS.
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <array>

#include "gateway/page_stream_session.h"

namespace roboss {
namespace {

namespace ssl = boost::asio::ssl;

constexpr auto kLastWord = std::chrono::seconds(2);
/// Ciphers of TLS 1.2, all with forward secrecy. Those of 1.3 need no choice.
constexpr const char* kCiphers = "ECDHE+AESGCM:ECDHE+CHACHA20";

Error bad_certificate(const std::string& what, const std::string& why) {
    return {"the page cannot be served over TLS: " + what + ": " + why,
            "give a certificate (with those between it and its authority behind it) and its key, both PEM",
            "bad-certificate"};
}

}  // namespace

void PageStream::finish(std::shared_ptr<void> session) {
    if (Tls* tls = std::get_if<Tls>(&way_)) {
        tcp().expires_after(kLastWord);
        return tls->async_shutdown([session = std::move(session)](boost::beast::error_code) {});
    }
    boost::beast::error_code ignored;
    tcp().socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
}

Result<std::shared_ptr<ssl::context>> tls_context(const KeyPair& pair) {
    auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
    SSL_CTX* native = context->native_handle();
    SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
    SSL_CTX_set_cipher_list(native, kCiphers);
    SSL_CTX_set_options(native, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
    boost::system::error_code error;
    // Without a callback OpenSSL would ask the terminal for the password of an encrypted key.
    context->set_password_callback([](std::size_t, ssl::context::password_purpose) { return std::string(); },
                                   error);
    context->use_certificate_chain(boost::asio::buffer(pair.certificate), error);
    if (error) return bad_certificate("its certificate cannot be read", error.message());
    context->use_private_key(boost::asio::buffer(pair.key), ssl::context::pem, error);
    if (error) return bad_certificate("its key cannot be read or is of another certificate", error.message());
    return context;
}

std::string fingerprint_of(ssl::context& context) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned bytes = 0;
    const X509* certificate = SSL_CTX_get0_certificate(context.native_handle());
    if (certificate == nullptr || X509_digest(certificate, EVP_sha256(), digest.data(), &bytes) != 1)
        return {};
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string text;
    for (unsigned i = 0; i < bytes; ++i) {
        if (i > 0) text += ':';
        text += kDigits[digest[i] >> 4];
        text += kDigits[digest[i] & 15];
    }
    return text;
}

}  // namespace roboss
