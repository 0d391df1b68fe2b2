// Owning pointers to OpenSSL's objects. Only source files of this layer include this header.
#pragma once

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <memory>
#include <string>

#include "core/result.h"
#include "net/certificates.h"

namespace roboss::openssl {

template <auto free>
struct Free {
    template <class T>
    void operator()(T* object) const {
        free(object);
    }
};
template <class T, auto free>
using Owned = std::unique_ptr<T, Free<free>>;

using Bio = Owned<BIO, BIO_free_all>;
using Key = Owned<EVP_PKEY, EVP_PKEY_free>;
using Certificate = Owned<X509, X509_free>;
using Context = Owned<SSL_CTX, SSL_CTX_free>;
using Session = Owned<SSL, SSL_free>;

inline Bio bio_of(const std::string& text) {
    return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}
inline Certificate certificate_of(const std::string& pem) {
    return Certificate(PEM_read_bio_X509(bio_of(pem).get(), nullptr, nullptr, nullptr));
}
inline Key key_of(const std::string& pem) {
    // Without a callback OpenSSL would ask the terminal for the password of an encrypted key.
    return Key(PEM_read_bio_PrivateKey(
        bio_of(pem).get(), nullptr, [](char*, int, int, void*) { return -1; }, nullptr));
}

/// OpenSSL's own words for the first error on this thread's list, which is emptied.
std::string take_error();

/// Whom a certificate names.
Result<Holder> holder_of(const X509* certificate);

}  // namespace roboss::openssl
