// The state of the Switchboard's own thread. Only its source files include this.
#pragma once

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <filesystem>
#include <optional>
#include <thread>

#include "net/meeting_place.h"
#include "net/spare_file.h"
#include "net/switchboard.h"

namespace roboss {

struct Switchboard::Thread {
    using Tcp = boost::asio::ip::tcp;

    static constexpr std::int64_t kRetry_ms = 50, kRetryLongest_ms = 2'000;

    boost::asio::io_context context{1};
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work{context.get_executor()};
    boost::asio::steady_timer turn{context}, rest{context};
    std::int64_t turned_ms = 0;

    // The Controller uses these:
    Tcp::acceptor acceptor{context};
    std::shared_ptr<const TlsContext> tls;
    std::optional<MeetingPlace> meeting;
    SpareFile spare;             // makes room for one call more, so that it can be refused
    std::string accept_trouble;  // the last one that was reported
    std::int64_t judged_ms = 0;  // when the list of revoked keys was looked at
    std::filesystem::file_time_type revoked_changed{};

    // A member uses these:
    Tcp::socket caller{context};
    std::shared_ptr<const TlsContext> calling_with;
    std::int64_t called_ms = 0, retry_ms = kRetry_ms, next_call_ms = 0;
    bool calling = false, was_connected = false;
    std::string found_key;  // the certificate that the last call found by the name of the run; empty: --keys
    bool outdated = false;  // another Controller has replaced the one whose key that was

    std::thread thread;
};

}  // namespace roboss
