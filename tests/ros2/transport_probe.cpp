// A small process that uses Transport, for transport_test.py: two nodes, a publisher, a latched one, an image
// of a megabyte, a subscription that is echoed, a service. It obeys lines of its standard input and answers
// each with a line:
//   stats      megabytes of memory, the longest publish() in ms since the last call, messages and calls so
//   far churn N    adds and removes a node with a publisher, a subscription and a service N times confirm MS
//   waits for confirmations of all messages retype     tries to publish another type on a topic that it has
//   quit       ends
// Notices of Transport are printed as "notice TEXT".
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "ros2_types/cdr.h"
#include "ros2_types/messages/sensor_messages.h"
#include "ros2_types/messages/standard_messages.h"
#include "ros2_types/messages/standard_services.h"
#include "ros2_types/open_transport.h"
#include "ros2_types/type_description.h"

using namespace roboss;
using namespace roboss::ros2;
using Steady = std::chrono::steady_clock;

namespace {

const ServiceType& kTrigger = type_of_service<std_srvs::Trigger>();

double ms_since(Steady::time_point start) {
    return std::chrono::duration<double, std::milli>(Steady::now() - start).count();
}

// Resident memory of this process.
double memory_mb() {
    std::ifstream file("/proc/self/statm");
    long pages = 0, resident = 0;
    file >> pages >> resident;
    return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / 1e6;
}

template <class T>
T checked(Result<T> result) {
    if (!result) {
        std::cerr << result.error().text() << std::endl;
        std::exit(3);
    }
    return std::move(result).value();
}

class Probe {
  public:
    Probe(Transport& transport, bool has_image) : transport_(transport) {
        const EntityId talker = transport.add_node("/", "talker");
        const EntityId driver = transport.add_node("/car_3", "driver");
        chatter_ = checked(transport.add_publisher(talker, "/chatter", type_of<String>(), {}));
        const EntityId latched = checked(transport.add_publisher(
            talker, "/car_3/robot_description", type_of<String>(), {.is_latched = true, .depth = 1}));
        if (has_image)
            image_ = checked(
                transport.add_publisher(driver, "/car_3/image_raw", type_of<ImageMessage>(), {.depth = 2}));
        echo_ = checked(transport.add_publisher(driver, "/car_3/echo", type_of<TwistMessage>(), {}));
        orders_ = checked(transport.add_subscription(driver, "/car_3/cmd_vel", type_of<TwistMessage>(), {}));
        service_ = checked(transport.add_service(driver, "/car_3/reset", kTrigger));
        transport.publish(latched, to_cdr(String{"<robot/>"}));
        transport.announce();
        node_ = driver;
    }

    // A turn of 20 ms or less.
    void turn(int number) {
        if (number % 5 == 0) publish(chatter_, to_cdr(String{"hello " + std::to_string(number / 5)}));
        if (image_ != 0 && number % 20 == 0) publish_image();
        for (Incoming& message : transport_.take(10)) accept(message);
        for (const std::string& notice : transport_.take_notices())
            std::cout << "notice " << notice << std::endl;
    }

    // False: the end.
    bool obey(const std::string& line) {
        std::istringstream words(line);
        std::string word;
        int number = 0;
        words >> word >> number;
        if (word == "quit") return false;
        if (word == "stats") {
            std::cout << "stats " << memory_mb() << " " << longest_ms_ << " " << messages_ << " " << calls_
                      << " " << transport_.subscribers(chatter_) << std::endl;
            longest_ms_ = 0;
        } else if (word == "churn") {
            for (int i = 0; i < number; ++i) churn(i);
            std::cout << "churn " << memory_mb() << std::endl;
        } else if (word == "confirm") {
            std::cout << "confirm " << transport_.await_confirmed(chatter_, number) << std::endl;
        } else if (word == "retype") {
            const auto other = transport_.add_publisher(node_, "/chatter", type_of<TwistMessage>(), {});
            std::cout << "retype " << (other ? "accepted" : other.error().code) << std::endl;
        }
        return true;
    }

  private:
    void publish(EntityId publisher, const std::string& cdr) {
        const auto start = Steady::now();
        transport_.publish(publisher, cdr);
        longest_ms_ = std::max(longest_ms_, ms_since(start));
    }

    void publish_image() {
        ImageMessage image;
        image.height = image.width = 1000;
        image.encoding = "mono8";
        image.step = 1000;
        image.data.assign(1'000'000, static_cast<std::uint8_t>(images_++));
        publish(image_, to_cdr(image));
    }

    void accept(const Incoming& message) {
        if (message.entity == orders_) {
            ++messages_;
            if (const auto twist = from_cdr<TwistMessage>(message.bytes))
                publish(echo_, to_cdr(twist.value()));
            std::cout << "message " << message.peer_type << " " << message.call.number << std::endl;
        } else if (message.entity == service_) {
            ++calls_;
            std::cout << "call " << message.peer_type << " dialect " << int(message.call.dialect) << " bytes "
                      << message.bytes.size() << std::endl;
            transport_.reply(
                service_, message.call,
                to_cdr(std_srvs::Trigger::Response{true, "call " + std::to_string(message.call.number)}));
        }
    }

    void churn(int number) {
        const std::string name = "car_" + std::to_string(number);
        const EntityId node = transport_.add_node("/" + name, "driver");
        const EntityId scan =
            checked(transport_.add_publisher(node, "/" + name + "/scan", type_of<LaserScan>(), {}));
        checked(transport_.add_subscription(node, "/" + name + "/cmd_vel", type_of<TwistMessage>(), {}));
        checked(transport_.add_service(node, "/" + name + "/reset", kTrigger));
        transport_.announce();
        transport_.publish(scan, to_cdr(LaserScan{}));
        transport_.take(1);
        transport_.remove(node);
        transport_.announce();
    }

    Transport& transport_;
    EntityId node_ = 0, chatter_ = 0, image_ = 0, echo_ = 0, orders_ = 0, service_ = 0;
    double longest_ms_ = 0;
    int messages_ = 0, calls_ = 0, images_ = 0;
};

// A line of standard input, if one is there now; "quit" at its end.
std::string line_of_input() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, 0) <= 0) return "";
    std::string line;
    return std::getline(std::cin, line) ? line : "quit";
}

}  // namespace

int main(int count, char** words) {
    TransportOptions options;
    bool has_image = false;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        if (word == "subnet") options.reach = TransportOptions::Reach::kSubnet;
        if (word == "off") options.reach = TransportOptions::Reach::kOff;
        if (word == "image") has_image = true;
        if (word == "long_gids") options.has_long_gids = true;
        if (word.starts_with("peer=")) options.peers.push_back(word.substr(5));
        if (word.starts_with("server=")) options.discovery_server = word.substr(7);
        if (word.starts_with("domain="))
            options.domain = static_cast<std::uint32_t>(std::stoi(word.substr(7)));
    }
    const auto transport = checked(open_transport(options));
    Probe probe(*transport, has_image);
    std::cout << "ready" << std::endl;
    for (int number = 0; probe.obey(line_of_input()); ++number) probe.turn(number);
}
