// See bag_orders.h.
#include "app/worlds/bag_orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "app/worlds/orders_file.h"
#include "bags/bag.h"
#include "bags/decompress.h"
#include "bags/simulated_time.h"
#include "model/powerless_joints.h"
#include "ros2/robot_commands.h"
#include "ros2/stamps.h"
#include "ros2_types/cdr.h"

namespace roboss {
namespace {

constexpr std::size_t kMostBagFaults = 1'000;                  // more tell nothing new
constexpr std::size_t kMostOrderBytes = std::size_t{4} << 30;  // of orders

std::string_view cdr_of(bags::Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

ros2::TopicOptions with_fleet(bool stamped) {
    ros2::TopicOptions options;
    options.stamped = stamped, options.fleet = true;
    return options;
}

/// The topics that drive robots, each with the types that it may have.
class BagTopics {
  public:
    explicit BagTopics(const std::shared_ptr<const Model>& model)
        : all_{ros2::RobotCommands(model, with_fleet(false)), ros2::RobotCommands(model, with_fleet(true))} {
        for (std::size_t c = 0; c < all_.size(); ++c)
            for (std::size_t t = 0; t < all_[c].topics().size(); ++t) {
                const ros2::CommandTopic& topic = all_[c].topics()[t];
                places_[topic.name].try_emplace(topic.type->name, Place{c, t});
            }
    }

    bool drives(const std::string& topic) const { return places_.contains(topic); }
    bool takes(const std::string& topic, const std::string& type) const {
        return places_.at(topic).contains(type);
    }
    /// "geometry_msgs/msg/Twist or geometry_msgs/msg/TwistStamped"
    std::string types(const std::string& topic) const {
        std::string names;
        for (const auto& [type, place] : places_.at(topic)) names += (names.empty() ? "" : " or ") + type;
        return names;
    }
    /// Some names, for a remedy.
    std::string examples() const {
        constexpr std::size_t kNamed = 3;
        std::string names;
        std::size_t named = 0;
        for (const auto& [name, types] : places_) {
            if (++named > kNamed) return names + ", ...";
            names += (named == 1 ? "" : ", ") + name;
        }
        return names.empty() ? "none" : names;
    }
    /// The orders of a message, without times. The topic takes the type.
    Result<std::vector<Order>> orders(const std::string& topic, const std::string& type,
                                      std::string_view cdr) const {
        const Place place = places_.at(topic).at(type);
        Result<std::vector<ros2::RobotOrder>> found = all_[place.commands].orders(place.topic, cdr);
        if (!found) return found.error();
        std::vector<Order> orders;
        for (ros2::RobotOrder& asked : found.value()) {
            Order& order = orders.emplace_back();
            order.robot = asked.robot, order.action = std::move(asked.action);
        }
        return orders;
    }

  private:
    struct Place {
        std::size_t commands = 0, topic = 0;
    };
    std::vector<ros2::RobotCommands> all_;                        // velocities plain, and stamped
    std::map<std::string, std::map<std::string, Place>> places_;  // by topic and type
};

/// Memory that an order takes, about.
std::size_t memory_of(const Order& order) {
    const auto* command = std::get_if<Command>(&order.action);
    return sizeof(Order) + sizeof(std::int64_t) +
           (command == nullptr ? 0 : command->values.size() * sizeof(double));
}

/// Makes orders of the messages of a bag.
class OrderSink : public bags::Sink {
  public:
    OrderSink(const std::shared_ptr<const Model>& model, Diagnostics& diagnostics)
        : model_(*model), topics_(model), diagnostics_(diagnostics) {}

    bool wants(const bags::Topic& topic) override {
        if (!is_clock(topic) && !topics_.drives(topic.name)) return others_.insert(topic.name), false;
        if (topic.encoding != "cdr") {
            fault(topic, Severity::kError,
                  {fmt::format("{} has messages in '{}', not in CDR", topic.name, topic.encoding),
                   "convert the bag to ROS 2", "bad-encoding"});
            return false;
        }
        if (is_clock(topic) || topics_.takes(topic.name, topic.type)) return true;
        fault(topic, Severity::kError,
              {fmt::format("{} has messages of the type '{}', not of {}", topic.name, topic.type,
                           topics_.types(topic.name)),
               "leave the topic out, or name it otherwise (`ros2 bag convert`)", "wrong-type"});
        return false;
    }

    Result<> take(const bags::Topic& topic, const bags::Message& message) override {
        if (is_clock(topic))
            take_clock(topic, message);
        else
            take_command(topic, message);
        if (bytes_ <= kMostOrderBytes) return Ok{};
        return Error{fmt::format("there are more than {} commands", commands_.size()),
                     "cut the bag (`ros2 bag convert`)", "too-large"};
    }

    /// All orders at their ticks.
    BagOrders finish(const std::string& path, std::optional<std::int64_t> earliest_ns) {
        BagOrders result;
        result.summary = fmt::format("{} {} on {} {} of {}; {} other {} no robot of this world", messages_,
                                     messages_ == 1 ? "command" : "commands", driven_.size(),
                                     driven_.size() == 1 ? "topic" : "topics", path, others_.size(),
                                     others_.size() == 1 ? "topic drives" : "topics drive");
        if (messages_ == 0 && !diagnostics_.has_errors())
            diagnostics_.warning({path, 0}, "no-commands",
                                 "no message of the bag drives a robot of this world",
                                 "the topics that do: " + topics_.examples());
        const auto time = bags::SimulatedTime::make(std::move(clock_), earliest_ns.value_or(0));
        if (!time) {
            diagnostics_.error({path, 0}, time.error().code, time.error().message, time.error().remedy);
            return result;
        }
        std::ranges::stable_sort(commands_, {}, &Timed::log_ns);
        std::size_t early = 0;
        for (Timed& command : commands_) {
            const std::int64_t time_ns = time.value().at(command.log_ns);
            if (time_ns < 0) ++early;
            command.order.apply_at =
                tick_at(static_cast<double>(std::max<std::int64_t>(0, time_ns)) / 1e9, model_.dt_s);
            command.order.sequence = result.orders.size() + 1;
            result.orders.push_back(std::move(command.order));
        }
        if (early > 0)
            diagnostics_.warning({path, 0}, "early-commands",
                                 fmt::format("{} orders are from before the time 0 of /clock", early),
                                 "they are given at the start");
        return result;
    }

  private:
    struct Timed {
        std::int64_t log_ns = 0;
        Order order;
    };

    static bool is_clock(const bags::Topic& topic) {
        return topic.name == "/clock" && topic.type == ros2::Clock::kName;
    }

    void take_clock(const bags::Topic& topic, const bags::Message& message) {
        const Result<ros2::Clock> clock = ros2::from_cdr<ros2::Clock>(cdr_of(message.bytes));
        if (!clock)
            return fault(
                topic, message,
                {topic.name + ": " + clock.error().message, clock.error().remedy, clock.error().code});
        clock_.push_back({message.log_ns, ros2::nanoseconds(clock.value().clock)});
        bytes_ += sizeof clock_.back();
    }

    void take_command(const bags::Topic& topic, const bags::Message& message) {
        const std::string_view cdr = cdr_of(message.bytes);
        if (cdr.starts_with(bags::kZstdMagic))  // no CDR begins so
            return fault(topic, message,
                         {topic.name + ": it is compressed by itself", "unpack the bag (`ros2 bag convert`)",
                          "compressed-message"});
        Result<std::vector<Order>> orders = topics_.orders(topic.name, topic.type, cdr);
        if (!orders) return fault(topic, message, orders.error());
        ++messages_;
        driven_.insert(topic.name);
        for (Order& order : orders.value()) {
            if (const Result<> checked = check_order(model_, order); !checked) {
                fault(topic, message,
                      {topic.name + ": " + checked.error().message, checked.error().remedy,
                       checked.error().code});
                continue;
            }
            bytes_ += memory_of(order);
            commands_.push_back({message.log_ns, std::move(order)});
        }
    }

    /// `why`: its text begins with the topic.
    void fault(const bags::Topic& topic, const bags::Message& message, const Error& why) {
        // The fault of the robot's file, not of the bag, as in an orders file.
        const bool powerless = is_of_zero_limit(why.code);
        fault(topic, powerless ? Severity::kWarning : Severity::kError,
              {fmt::format("message {} of {}", message.number, why.message), why.remedy,
               why.code.empty() ? "bad-order" : why.code});
    }

    void fault(const bags::Topic& topic, Severity severity, const Error& why) {
        if (++faults_[severity] <= kMostBagFaults)
            diagnostics_.add({severity, {topic.file, 0}, why.code, why.message, why.remedy, false});
    }

    const Model& model_;
    BagTopics topics_;
    Diagnostics& diagnostics_;
    std::vector<Timed> commands_;
    std::vector<bags::ClockReading> clock_;
    std::set<std::string> driven_, others_;  // topics
    std::map<Severity, std::size_t> faults_;
    std::size_t messages_ = 0;  // that are commands
    std::size_t bytes_ = 0;     // of orders and readings of the clock
};

}  // namespace

BagOrders load_bag_orders(const std::string& path, const std::shared_ptr<const Model>& model,
                          Diagnostics& diagnostics) {
    OrderSink sink(model, diagnostics);
    const std::optional<std::int64_t> earliest_ns = bags::read_bag(path, sink, diagnostics);
    return sink.finish(path, earliest_ns);
}

}  // namespace roboss
