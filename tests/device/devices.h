// What tests of devices share: worlds from files, a line in memory, and a Khepera that answers on it.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>

#include <support/random.h>

#include "device/device_run.h"
#include "device/khepera.h"
#include "sdf/load_world.h"

namespace roboss::test {

inline std::shared_ptr<const Model> world_file(const std::string& name) {
    Diagnostics diagnostics;
    const auto world = load_world(std::string(ROBOSS_WORLDS) + "/" + name, {{}, {}, false}, diagnostics);
    EXPECT_TRUE(world && !diagnostics.has_errors()) << name;
    return compile(*world, {}, diagnostics);
}

inline RobotId id_of(const Model& model, const std::string& name) {
    const auto robot = model.find_robot(name);
    EXPECT_TRUE(robot) << name;
    return robot.value_or(RobotId(0u));
}

/// With some bytes more and some less.
inline std::string disturbed(std::string bytes, Random& random) {
    const auto place = [&] {
        return static_cast<std::size_t>(random.integer(0, static_cast<int>(bytes.size()) - 1));
    };
    while (!bytes.empty() && random.integer(0, 2) == 0)
        bytes.insert(place(), 1, static_cast<char>(random.integer(-128, 127)));
    while (!bytes.empty() && random.integer(0, 2) == 0) bytes.erase(place(), 1);
    return bytes;
}

/// What a device would do at the other end of a line.
class FakeDevice {
  public:
    virtual ~FakeDevice() = default;
    virtual void hear(const std::string& bytes) = 0;
    std::vector<std::string> say() { return std::exchange(said, {}); }
    std::vector<std::string> said;
};

/// A line without a cable. `cut`: it is broken, and cannot be opened.
class FakeLine final : public DeviceLine {
  public:
    explicit FakeLine(FakeDevice& device) : device_(device) {}
    Result<> send(std::string_view bytes) override {
        if (cut) return Error{"cut", "", "no-line"};
        device_.hear(std::string(bytes));
        return Ok{};
    }
    Result<std::vector<std::string>> receive() override {
        if (cut) return Error{"cut", "", "no-line"};
        return device_.say();
    }
    Result<> reopen() override { return cut ? Result<>(Error{"cut", "", "no-line"}) : Result<>(Ok{}); }
    const std::string& address() const override { return address_; }

    bool cut = false;

  private:
    FakeDevice& device_;
    std::string address_ = "fake";
};

/// Answers as the manual says; its wheels are turned by tests.
class FakeKhepera final : public FakeDevice {
  public:
    void hear(const std::string& bytes) override {
        for (const char c : bytes) {
            if (c != '\n') {
                part_ += c;
                continue;
            }
            const std::string command = std::exchange(part_, {});
            if (command.empty()) continue;
            heard = command;
            if (!mute) answer(command);
        }
    }
    void boot() {
        speeds = {}, counts = {};
        said.push_back("\r\nK-TEAM KHEPERA\r\nROM of 5.01\r\n");
    }

    std::array<int, 2> speeds{}, turning{};  // ordered; measured
    std::array<long, 2> counts{};
    std::array<int, 8> eyes{};
    bool mute = false;
    std::string heard;  // the last command

  private:
    void answer(const std::string& command) {
        const auto two = [](long a, long b) { return "," + std::to_string(a) + "," + std::to_string(b); };
        if (command[0] == 'D') {
            const std::size_t comma = command.find(',', 2);
            speeds = {std::stoi(command.substr(2)), std::stoi(command.substr(comma + 1))};
            said.push_back("d\r\n");
        } else if (command == "H") {
            said.push_back("h" + two(counts[0], counts[1]) + "\r\n");
        } else if (command == "E") {
            said.push_back("e" + two(turning[0], turning[1]) + "\r\n");
        } else if (command == "N") {
            std::string reply = "n";
            for (const int eye : eyes) reply += "," + std::to_string(eye);
            said.push_back(reply + "\r\n");
        }
    }
    std::string part_;
};

}  // namespace roboss::test
