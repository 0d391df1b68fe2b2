// OpenSSL's X509 functions.
#include "net/certificates.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>
#include <optional>

#include "net/openssl.h"

namespace roboss {
namespace {

using namespace openssl;

constexpr std::array<const char*, 4> kSeats{"controller", "simulator", "client", "member"};
constexpr long kClockSkew_s = 300;     // clocks of two computers may differ by so much
constexpr std::size_t kNameMost = 64;  // of a common name in X.509

using Number = Owned<BIGNUM, BN_free>;

Error failed(const std::string& what) {
    return {what + ": " + take_error(), "check the OpenSSL library of this computer", "openssl"};
}

/// Positive, and never the same twice.
bool set_serial(X509* certificate) {
    const Number number(BN_new());
    return number && BN_rand(number.get(), 127, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1 &&
           BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate)) != nullptr;
}

bool add_word(X509_NAME* name, const char* field, const std::string& text) {
    return X509_NAME_add_entry_by_txt(name, field, MBSTRING_UTF8,
                                      reinterpret_cast<const unsigned char*>(text.data()),
                                      static_cast<int>(text.size()), -1, 0) == 1;
}

bool extend(X509* certificate, int kind, const char* value) {
    const Owned<X509_EXTENSION, X509_EXTENSION_free> extension(
        X509V3_EXT_conf_nid(nullptr, nullptr, kind, value));
    return extension && X509_add_ext(certificate, extension.get(), -1) == 1;
}

/// A certificate of a new key, not yet signed.
struct Draft {
    Certificate certificate;
    Key key;
};

/// `rights`: empty: it says none.
std::optional<Draft> draft(const std::string& name, const std::string& unit, int days,
                           const std::string& rights = {}) {
    Draft d{Certificate(X509_new()), Key(EVP_EC_gen("P-256"))};
    if (!d.certificate || !d.key) return std::nullopt;
    X509* c = d.certificate.get();
    X509_NAME* subject = X509_get_subject_name(c);
    const bool done = X509_set_version(c, X509_VERSION_3) == 1 && set_serial(c) &&
                      X509_gmtime_adj(X509_getm_notBefore(c), -kClockSkew_s) != nullptr &&
                      X509_time_adj_ex(X509_getm_notAfter(c), days, 0, nullptr) != nullptr &&
                      X509_set_pubkey(c, d.key.get()) == 1 && add_word(subject, "OU", unit) &&
                      add_word(subject, "CN", name) &&
                      (rights.empty() || add_word(subject, "description", rights));
    if (!done) return std::nullopt;
    return d;
}

template <class Write>
std::string pem(const Write& write) {
    const Bio bio(BIO_new(BIO_s_mem()));
    if (!bio || write(bio.get()) != 1) return {};
    char* data = nullptr;
    const long bytes = BIO_get_mem_data(bio.get(), &data);
    return std::string(data, static_cast<std::size_t>(bytes));
}

Result<KeyPair> signed_by(Draft d, EVP_PKEY* authority) {
    if (X509_sign(d.certificate.get(), authority, EVP_sha256()) == 0)
        return failed("a certificate cannot be signed");
    KeyPair pair;
    pair.certificate = pem([&](BIO* bio) { return PEM_write_bio_X509(bio, d.certificate.get()); });
    pair.key = pem([&](BIO* bio) {
        return PEM_write_bio_PrivateKey(bio, d.key.get(), nullptr, nullptr, 0, nullptr, nullptr);
    });
    if (pair.certificate.empty() || pair.key.empty()) return failed("a certificate cannot be written");
    return pair;
}

Result<> check_name(const std::string& name) {
    const bool printable = name.find(char{0}) == std::string::npos;
    if (!name.empty() && name.size() <= kNameMost && printable) return Ok{};
    return Error{"'" + name + "' is no name for a certificate", "give 1 to 64 bytes", "bad-name"};
}

/// Names of a server as OpenSSL's configuration has them: "IP:192.0.2.7,DNS:lab".
std::string subject_names(const std::vector<std::string>& names) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '.' || c == '_';
    };
    std::string text;
    for (const std::string& name : names) {
        const Owned<ASN1_OCTET_STRING, ASN1_OCTET_STRING_free> address(a2i_IPADDRESS(name.c_str()));
        if (!address && (name.empty() || !std::ranges::all_of(name, plain))) continue;
        text += (text.empty() ? "" : ",") + std::string(address ? "IP:" : "DNS:") + name;
    }
    ERR_clear_error();
    return text;
}

std::string word(const X509_NAME* name, int field) {
    const int at = X509_NAME_get_index_by_NID(name, field, -1);
    if (at < 0) return {};
    unsigned char* text = nullptr;
    const int bytes = ASN1_STRING_to_UTF8(&text, X509_NAME_ENTRY_get_data(X509_NAME_get_entry(name, at)));
    if (bytes < 0) return {};
    std::string result(reinterpret_cast<char*>(text), static_cast<std::size_t>(bytes));
    OPENSSL_free(text);
    return result;
}

}  // namespace

namespace openssl {

std::string take_error() {
    const unsigned long code = ERR_get_error();
    ERR_clear_error();
    const char* reason = code == 0 ? nullptr : ERR_reason_error_string(code);
    return reason == nullptr ? "no reason is given" : reason;
}

Result<Holder> holder_of(const X509* certificate) {
    const X509_NAME* subject = X509_get_subject_name(certificate);
    Holder holder;
    holder.name = word(subject, NID_commonName);
    const Result<Seat> seat = seat_of(word(subject, NID_organizationalUnitName));
    if (holder.name.empty() || !seat)
        return Error{"the certificate names no role of RoBOSS", "make it with `roboss keys`", "not-ours"};
    holder.seat = seat.value();
    if (const std::string text = word(subject, NID_description); !text.empty()) {
        Result<Rights> rights = rights_of(text);
        if (!rights) return rights.error();
        holder.rights = std::move(rights).value();
    }
    holder.rights.key = holder.name;
    const Number number(ASN1_INTEGER_to_BN(X509_get0_serialNumber(certificate), nullptr));
    if (char* text = number ? BN_bn2hex(number.get()) : nullptr) holder.serial = text, OPENSSL_free(text);
    tm end{};
    std::array<char, 32> text{};
    if (ASN1_TIME_to_tm(X509_get0_notAfter(certificate), &end) == 1 &&
        std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &end) > 0)
        holder.expires = text.data();
    return holder;
}

}  // namespace openssl

const char* seat_name(Seat seat) {
    return kSeats[static_cast<std::size_t>(seat)];
}

Result<Seat> seat_of(const std::string& name) {
    for (std::size_t i = 0; i < kSeats.size(); ++i)
        if (name == kSeats[i]) return static_cast<Seat>(i);
    return Error{"there is no role '" + name + "'", "give controller, simulator, client or member",
                 "bad-role"};
}

Result<KeyPair> new_authority(const std::string& name, int days) {
    if (Result<> named = check_name(name); !named) return named.error();
    std::optional<Draft> d = draft(name, "authority", days);
    if (!d) return failed("no key can be made");
    X509* c = d->certificate.get();
    if (X509_set_issuer_name(c, X509_get_subject_name(c)) != 1 ||
        !extend(c, NID_basic_constraints, "critical,CA:TRUE") ||
        !extend(c, NID_key_usage, "critical,keyCertSign"))
        return failed("no certificate can be made");
    EVP_PKEY* own = d->key.get();
    return signed_by(std::move(*d), own);
}

Result<KeyPair> new_certificate(const KeyPair& authority, const Holder& holder, int days) {
    if (Result<> named = check_name(holder.name); !named) return named.error();
    const bool limited = !holder.rights.everything();
    if (limited && holder.seat != Seat::kClient)
        return Error{std::string("the rights of a ") + seat_name(holder.seat) + " cannot be limited",
                     "give the role client", "bad-rights"};
    const Certificate issuer = certificate_of(authority.certificate);
    const Key key = key_of(authority.key);
    if (!issuer || !key) return failed("the authority's certificate and key cannot be read");
    std::optional<Draft> d =
        draft(holder.name, seat_name(holder.seat), days, limited ? rights_text(holder.rights) : "");
    if (!d) return failed("no key can be made");
    X509* c = d->certificate.get();
    if (X509_set_issuer_name(c, X509_get_subject_name(issuer.get())) != 1 ||
        !extend(c, NID_basic_constraints, "critical,CA:FALSE") ||
        !extend(c, NID_ext_key_usage, "serverAuth,clientAuth"))
        return failed("no certificate can be made");
    return signed_by(std::move(*d), key.get());
}

Result<KeyPair> new_server_certificate(const std::vector<std::string>& names, int days) {
    std::optional<Draft> d = draft("roboss page", "server", days);
    if (!d) return failed("no key can be made");
    X509* c = d->certificate.get();
    if (X509_set_issuer_name(c, X509_get_subject_name(c)) != 1 ||
        !extend(c, NID_basic_constraints, "critical,CA:FALSE") || !extend(c, NID_ext_key_usage, "serverAuth"))
        return failed("no certificate can be made");
    if (const std::string called = subject_names(names);
        !called.empty() && !extend(c, NID_subject_alt_name, called.c_str()))
        return failed("no certificate can be made for " + called);
    EVP_PKEY* own = d->key.get();
    return signed_by(std::move(*d), own);
}

Result<Holder> holder_of(const std::string& certificate) {
    const Certificate c = certificate_of(certificate);
    if (!c) return Error{"this is no certificate: " + take_error(), "make it with `roboss keys`", "not-ours"};
    return openssl::holder_of(c.get());
}

}  // namespace roboss
