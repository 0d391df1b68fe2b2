// Keys for tests of members that meet, and of those that are refused.
#pragma once

#include <support/loopback_bus.h>
#include <filesystem>

#include "net/key_ring.h"

namespace roboss::test {

/// A ring of keys in a folder of its own.
class Keys {
  public:
    Keys() : folder_(::testing::TempDir() + "roboss-keys-XXXXXX") {
        EXPECT_NE(mkdtemp(folder_.data()), nullptr);
    }
    ~Keys() { std::filesystem::remove_all(folder_); }
    KeyRing ring(const std::string& name = "ring") const {
        return KeyRing::open(folder_ + "/" + name).value();
    }
    /// The folder of a key, made on first use.
    std::string of(const std::string& name, Seat seat, const std::string& ring_name = "ring", int days = 1,
                   const Rights& rights = {}) const {
        KeyRing keys = ring(ring_name);
        if (!keys.has(name)) {
            const Result<> added = keys.add(name, seat, days, rights);
            EXPECT_TRUE(added.ok());
        }
        return folder_ + "/" + ring_name + "/" + name;
    }

  private:
    std::string folder_;
};

inline NetOptions with_keys(NetOptions options, const std::string& keys) {
    options.keys = keys;
    return options;
}

inline std::string all_of(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

/// The member is refused with this code, for a reason that has these words, and the Controller names it. The
/// member guesses at no other reason.
inline void expect_refused(StreamBus& controller, StreamBus& member, const std::string& code,
                           const std::string& words) {
    ASSERT_TRUE(becomes([&] { return member.refusal().has_value(); })) << all_of(member.take_notices());
    EXPECT_EQ(member.refusal()->code, code);
    EXPECT_NE(member.refusal()->message.find(words), std::string::npos) << member.refusal()->message;
    std::string said;
    EXPECT_TRUE(becomes([&] {
        return (said += all_of(controller.take_notices())).find("[" + code + "]") != std::string::npos;
    })) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said;
    usleep(100'000);
    const std::string guessed = all_of(member.take_notices());
    EXPECT_EQ(guessed.find("--insecure"), std::string::npos) << guessed;
    EXPECT_EQ(guessed.find("[reconnecting]"), std::string::npos) << guessed;
}

}  // namespace roboss::test
