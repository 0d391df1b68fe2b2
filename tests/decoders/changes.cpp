// Every round has a seed of its own, so any of them can be repeated alone.
#include "changes.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <iterator>
#include <random>

#include <support/fuzz_rounds.h>

#include "core/thread_cpu.h"

namespace roboss::test {
namespace {

constexpr std::uint64_t kLongest_ns = 20'000'000'000;  // with sanitizers, on a busy computer

constexpr std::array<const char*, 16> kNumbers{
    "0",     "-1",        "nan",   "inf",  "1e308",      "-1e308", "1e-320", "2147483648",
    "65536", "999999999", "1 2 3", "-0.0", "0x7fffffff", "1e9999", "",       "4294967295"};

/// The input that is being read, for a process that ends by a signal.
std::string current;
std::string kept_as;

void keep(int signal) {
    const int file = ::open(kept_as.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    (void)!::write(file, current.data(), current.size());
    ::close(file);
    (void)!::write(STDERR_FILENO, "\nthe input is kept: ", 20);
    (void)!::write(STDERR_FILENO, kept_as.data(), kept_as.size());
    (void)!::write(STDERR_FILENO, "\n", 1);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

bool of_number(char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == '-';
}

class Changes {
  public:
    Changes(std::string bytes, std::size_t seed) : bytes_(std::move(bytes)), random_(seed) {}

    std::string take() {
        for (std::size_t n = 1 + below(3); n > 0 && !bytes_.empty(); --n) change();
        return std::move(bytes_);
    }

  private:
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
    std::size_t anywhere() { return below(bytes_.size()); }
    std::size_t length(std::size_t at) { return std::min(bytes_.size() - at, std::size_t{1} << below(9)); }

    void change() {
        const std::size_t at = anywhere();
        switch (below(8)) {
            case 0:
                bytes_[at] = static_cast<char>(bytes_[at] ^ (1 << below(8)));
                break;
            case 1:
                bytes_[at] = static_cast<char>(random_());
                break;
            case 2:
                for (std::size_t i = at; i < std::min(at + 4, bytes_.size()); ++i)
                    bytes_[i] = below(2) == 0 ? '\xFF' : '\0';
                break;
            case 3:
                bytes_.erase(at, length(at));
                break;
            case 4:
                bytes_.insert(anywhere(), bytes_.substr(at, length(at)));
                break;
            case 5:
                if (below(4) == 0) bytes_.resize(at);
                break;
            default:
                number(at);
        }
    }

    /// Another number where the next one stands.
    void number(std::size_t at) {
        while (at < bytes_.size() && !of_number(bytes_[at])) ++at;
        std::size_t end = at;
        while (end < bytes_.size() && of_number(bytes_[end])) ++end;
        bytes_.replace(at, end - at, kNumbers[below(kNumbers.size())]);
    }

    std::string bytes_;
    std::mt19937_64 random_;
};

}  // namespace

std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string changed(const std::string& good, std::size_t seed) {
    return Changes(good, seed).take();
}

void expect_total(const Decoder& decoder, const std::string& cases) {
    ASSERT_FALSE(decoder.good.empty());
    const auto read = [&](std::string bytes, std::size_t which, const std::string& what) {
        current = std::move(bytes);
        kept_as = "failed-" + decoder.name + "-" + what;
        SCOPED_TRACE(kept_as);
        const std::uint64_t begin_ns = thread_cpu_ns();
        const bool taken = decoder.read(current, which);
        EXPECT_LT(thread_cpu_ns() - begin_ns, kLongest_ns);
        if (::testing::Test::HasFailure() && !std::filesystem::exists(kept_as))
            std::ofstream(kept_as, std::ios::binary) << current;
        return taken;
    };
    std::signal(SIGABRT, keep);
    for (std::size_t i = 0; i < decoder.good.size(); ++i)
        EXPECT_TRUE(read(decoder.good[i], i, "good-" + std::to_string(i)));
    std::error_code none;
    for (const auto& file : std::filesystem::directory_iterator(cases + "/" + decoder.name, none))
        (void)read(contents(file.path()), 0, file.path().filename());
    std::size_t taken = 0;
    const std::size_t rounds = fuzz_rounds(decoder.rounds);
    for (std::size_t round = 0; round < rounds && !::testing::Test::HasFailure(); ++round) {
        const std::size_t which = round % decoder.good.size();
        taken += read(changed(decoder.good[which], round), which, std::to_string(round));
    }
    std::signal(SIGABRT, SIG_DFL);
    std::printf("%s: %zu of %zu changed inputs taken\n", decoder.name.c_str(), taken, rounds);
    EXPECT_GT(taken, rounds / 100) << "the changes are too wild to reach much";
    EXPECT_LT(taken, rounds);
}

}  // namespace roboss::test
