// Keys and certificates of a run (X.509, elliptic curve P-256, as PEM text): an authority, and what it signs
// for each member. A certificate says who its holder is, in which role it may take part, and what a Client
// may order.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"
#include "wire/rights.h"

namespace roboss {

/// The roles that a certificate may give in a run.
enum class Seat : std::uint8_t {
    kController,
    kSimulator,
    kClient,
    kMember,  ///< Simulator or Client
};

/// "controller", "simulator", "client" or "member".
const char* seat_name(Seat seat);
/// The seat of such a name; an Error lists them.
Result<Seat> seat_of(const std::string& name);

/// A certificate and its private key, PEM.
struct KeyPair {
    std::string certificate, key;
};

/// Whom a certificate names.
struct Holder {
    std::string name;
    Seat seat = Seat::kMember;
    std::string serial{};   ///< of the certificate, hexadecimal
    std::string expires{};  ///< UTC, ISO 8601
    Rights rights{};        ///< of a Client; all others have everything
};

/// A new authority, which signs itself. An Error: the system gives no random numbers.
Result<KeyPair> new_authority(const std::string& name, int days);

/// A key for this holder, and its certificate, signed by the authority. An Error: the authority's texts are
/// no certificate and key, the name is empty or longer than 64 bytes, or the rights of another seat than
/// kClient are limited.
Result<KeyPair> new_certificate(const KeyPair& authority, const Holder& holder, int days);

/// A certificate that signs itself, for a server that browsers call by these names: names of computers and IP
/// addresses; what is neither is left out.
Result<KeyPair> new_server_certificate(const std::vector<std::string>& names, int days);

/// Whom a certificate (PEM) names. An Error: the text is none of ours.
Result<Holder> holder_of(const std::string& certificate);

}  // namespace roboss
