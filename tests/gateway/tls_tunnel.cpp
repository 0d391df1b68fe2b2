// Asio as a client.
#include "tls_tunnel.h"

#include <openssl/ssl.h>

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/write.hpp>
#include <mutex>
#include <thread>

namespace roboss::test {
namespace {

namespace asio = boost::asio;
namespace ssl = asio::ssl;
using tcp = asio::ip::tcp;
using Error = boost::system::error_code;

}  // namespace

struct TlsTunnel::Parts {
    /// One connection, in both directions.
    struct Link : std::enable_shared_from_this<Link> {
        Link(tcp::socket&& caller, ssl::context& context)
            : near(std::move(caller)), far(near.get_executor(), context) {}

        template <class From, class To>
        void pump(From& from, To& to, std::array<char, 16'384>& bytes) {
            from.async_read_some(asio::buffer(bytes), [this, self = shared_from_this(), &from, &to, &bytes](
                                                          Error error, std::size_t count) {
                if (error) return close();
                asio::async_write(to, asio::buffer(bytes, count),
                                  [this, self, &from, &to, &bytes](Error failed, std::size_t) {
                                      failed ? close() : pump(from, to, bytes);
                                  });
            });
        }
        void close() {
            Error ignored;
            near.close(ignored);
            far.next_layer().close(ignored);
        }

        tcp::socket near;
        ssl::stream<tcp::socket> far;
        std::array<char, 16'384> up{}, down{};
    };

    tcp::endpoint gateway;
    asio::io_context io{1};
    ssl::context context{ssl::context::tls_client};
    tcp::acceptor acceptor{io, tcp::endpoint(asio::ip::make_address("127.0.0.1"), 0)};
    mutable std::mutex mutex;
    std::string failure;
    std::thread thread;

    void accept() {
        acceptor.async_accept([this](Error error, tcp::socket caller) {
            if (error) return;
            auto link = std::make_shared<Link>(std::move(caller), context);
            link->far.next_layer().async_connect(gateway, [this, link](Error failed) {
                if (failed) return link->close();
                link->far.async_handshake(ssl::stream_base::client, [this, link](Error refused) {
                    if (!refused) {
                        link->pump(link->near, link->far, link->up);
                        return link->pump(link->far, link->near, link->down);
                    }
                    {
                        const std::scoped_lock lock(mutex);
                        failure = refused.message();
                    }
                    link->close();  // what the caller sees of it comes last
                });
            });
            accept();
        });
    }
};

TlsTunnel::TlsTunnel(const ViewerUrl& gateway, const TunnelOptions& options) : parts_(new Parts()) {
    Parts& p = *parts_;
    p.gateway = {asio::ip::make_address(gateway.host), static_cast<std::uint16_t>(std::stoi(gateway.port))};
    p.context.add_certificate_authority(asio::buffer(options.trusted));
    p.context.set_verify_mode(ssl::verify_peer);
    p.context.set_verify_callback(ssl::host_name_verification("127.0.0.1"));
    if (options.version != 0) {
        SSL_CTX_set_security_level(p.context.native_handle(),
                                   0);  // else OpenSSL itself offers no old version
        SSL_CTX_set_min_proto_version(p.context.native_handle(), options.version);
        SSL_CTX_set_max_proto_version(p.context.native_handle(), options.version);
    }
    p.accept();
    p.thread = std::thread([&p] { p.io.run(); });
}

TlsTunnel::~TlsTunnel() {
    parts_->io.stop();
    parts_->thread.join();
}

ViewerUrl TlsTunnel::url(const std::string& token) const {
    const std::string page =
        "http://127.0.0.1:" + std::to_string(parts_->acceptor.local_endpoint().port()) + "/";
    ViewerUrl url(token.empty() ? page : page + "?token=" + token);
    url.scheme = "https";
    return url;
}

std::string TlsTunnel::failure() const {
    const std::scoped_lock lock(parts_->mutex);
    return parts_->failure;
}

}  // namespace roboss::test
