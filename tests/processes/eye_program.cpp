// A control program with cameras: it writes a line for each image that its share of the robots sees,
// TICK ROBOT SENSOR HASH, to the file $ROBOSS_EYES. $ROBOSS_EYES_SHARE is "k/n": robots k, k + n ...
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "client/control_program.h"
#include "core/hash.h"

namespace {

std::string setting(const char* name, const char* fallback) {
    const char* const found = std::getenv(name);
    return found != nullptr ? found : fallback;
}

class Eyes : public roboss::ControlProgram {
  public:
    roboss::ControlOptions options() const override { return {.period_s = 0.1}; }

    void start(roboss::Client&) override {
        out_ = std::ofstream(setting("ROBOSS_EYES", "eyes.txt"));  // anew, with another world
        if (std::sscanf(setting("ROBOSS_EYES_SHARE", "0/1").c_str(), "%u/%u", &share_, &shares_) != 2)
            throw std::invalid_argument("ROBOSS_EYES_SHARE is not k/n");
    }

    void control(roboss::Client& client) override {
        const roboss::Model& model = client.model();
        for (std::uint32_t r = share_; r < model.robots.size(); r += shares_) {
            const roboss::RobotId robot(r);
            const auto& sensors = model.type_of(robot).sensors;
            for (std::size_t s = 0; s < sensors.size(); ++s)
                std::visit([&](const auto& spec) { look(client, robot, s, spec); },
                           sensors[s].spec.parameters);
        }
        out_.flush();
    }

  private:
    void look(roboss::Client&, roboss::RobotId, std::size_t, const roboss::UnsupportedSensor&) {}
    template <class Spec>
    void look(roboss::Client& client, roboss::RobotId robot, std::size_t sensor, const Spec&) {
        if (!Spec::kKind.is_image) return;
        const auto reading = client.reading<typename Spec::Reading>(robot, sensor);
        roboss::Hash hash;
        reading.fields([&](const roboss::ReadingField&, const auto& value) { add(hash, value); }, reading);
        out_ << client.tick() << ' ' << client.model().robots[robot.index()].name << ' ' << sensor << ' '
             << hash.value() << '\n';
    }
    template <class T>
    static void add(roboss::Hash& hash, const roboss::Image<T>& image) {
        for (const T sample : image.samples) hash.add(static_cast<double>(sample));
    }
    static void add(roboss::Hash& hash, const std::vector<double>& values) {
        for (const double value : values) hash.add(value);
    }
    template <class T>
    static void add(roboss::Hash&, const T&) {}

    std::ofstream out_;
    unsigned share_ = 0, shares_ = 1;
};

}  // namespace

ROBOSS_CONTROL_PROGRAM(Eyes)
