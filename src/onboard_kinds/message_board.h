// The message board of a world: topics of Gazebo that no robot of the world takes as a command, and what
// passes messages on (TriggeredPublisher, TouchPlugin, PerformerDetector). The importer puts it on a model of
// its own that has no shapes. The messages are its commands: latched, part of the state, seen by every
// Client. What reacts to them is a control program (client/triggers/triggers.h), since it looks at several
// robots.
#pragma once

#include <string>
#include <vector>

#include "math/pose.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// A value of a message: a number, or the number of a text in MessageBoardSpec::words.
struct BoardValue {
    std::string name;      ///< field of the message, "_" between its parts: "data", "linear_x"
    double value = 0;      ///< unset: 0
    bool is_text = false;  ///< whether `value` is the number of a word, from 1; 0: an empty text

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"name", "name"}, s.name);
        visit({"value", "value"}, s.value);
        visit({"is_text", "is_text"}, s.is_text);
    }
    /// Compares all members.
    friend bool operator==(const BoardValue&, const BoardValue&) = default;
};

/// A text that messages may hold.
struct BoardWord {
    std::string text;  ///< as in the message

    /// Calls visit(Parameter, value) for each parameter.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"text", "text"}, s.text);
    }
    /// Compares all members.
    friend bool operator==(const BoardWord&, const BoardWord&) = default;
};

/// A topic on the board.
struct BoardTopic {
    std::string name;                ///< of the channel, unique on the board
    std::string topic;               ///< of Gazebo
    std::string model;               ///< that the messages are about; empty: none
    std::vector<BoardValue> values;  ///< of a message

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"name", "name"}, s.name);
        visit({"topic", "topic"}, s.topic);
        visit({"model", "model"}, s.model);
        visit({"values", "values"}, s.values);
    }
    /// Compares all members.
    friend bool operator==(const BoardTopic&, const BoardTopic&) = default;
};

/// A condition on a message.
struct BoardMatch {
    bool whole = false;              ///< values that are not named must be 0
    bool negative = false;           ///< the comparison must fail
    bool any_order = false;          ///< elements of a repeated field ("data_0") may stand anywhere in it
    double tolerance = 1e-8;         ///< of numbers
    std::vector<BoardValue> values;  ///< that the message must have

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"whole", "whole"}, s.whole);
        visit({"negative", "negative"}, s.negative);
        visit({"any_order", "any_order"}, s.any_order);
        visit({"tolerance", "tolerance"}, s.tolerance);
        visit({"values", "values"}, s.values);
    }
    /// Compares all members.
    friend bool operator==(const BoardMatch&, const BoardMatch&) = default;
};

/// A message that a trigger publishes.
struct BoardOutput {
    std::string topic;               ///< of Gazebo; of a service: its name
    std::string robot;               ///< set_pose: the robot that it puts; else empty
    Pose X_WR;                       ///< set_pose: where
    std::vector<BoardValue> values;  ///< of the message

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"topic", "topic"}, s.topic);
        visit({"robot", "robot"}, s.robot);
        visit({"X_WR", "pose"}, s.X_WR);
        visit({"values", "values"}, s.values);
    }
    /// Compares all members.
    friend bool operator==(const BoardOutput&, const BoardOutput&) = default;
};

/// TriggeredPublisher: a message starts others.
struct BoardTrigger {
    std::string topic;                 ///< of the input
    double delay = 0;                  ///< s, of simulated time
    std::vector<BoardMatch> matches;   ///< all must hold
    std::vector<BoardOutput> outputs;  ///< published in this order

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"topic", "topic"}, s.topic);
        visit({"delay", "delay", "s"}, s.delay);
        visit({"matches", "matches"}, s.matches);
        visit({"outputs", "outputs"}, s.outputs);
    }
    /// Compares all members.
    friend bool operator==(const BoardTrigger&, const BoardTrigger&) = default;
};

/// TouchPlugin: reports when a model has touched another for a time.
struct BoardTouch {
    std::string model;             ///< whose contacts count
    std::vector<BoardWord> links;  ///< of it, with a contact sensor
    std::string target;            ///< part of the name of what is touched, "model::link"
    double time = 0;               ///< s, that the contact must last
    bool enabled = false;          ///< at the start
    std::string enable;            ///< topic that switches it on and off
    std::string told;              ///< name of the board's channel that takes the message

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"model", "model"}, s.model);
        visit({"links", "links"}, s.links);
        visit({"target", "target"}, s.target);
        visit({"time", "time", "s"}, s.time);
        visit({"enabled", "enabled"}, s.enabled);
        visit({"enable", "enable"}, s.enable);
        visit({"told", "told"}, s.told);
    }
    /// Compares all members.
    friend bool operator==(const BoardTouch&, const BoardTouch&) = default;
};

/// PerformerDetector and one performer: reports when it enters a region and when it leaves it.
struct BoardDetector {
    std::string model;       ///< that has the region
    bool is_static = false;  ///< whether that model is scenery, at X_WM
    Pose X_WM;               ///< pose of a static model
    Vec3 size{1, 1, 1},      ///< m, edges of the region along the world's axes
        offset;              ///< m, of its centre, in the model's frame
    std::string performer;   ///< the robot that is looked for
    Vec3 performer_size;     ///< m, edges of the box about it, along the world's axes
    std::string told;        ///< name of the board's channel that takes the message
    int group = 0;           ///< entries of one detector have one number

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"model", "model"}, s.model);
        visit({"is_static", "is_static"}, s.is_static);
        visit({"X_WM", "pose"}, s.X_WM);
        visit({"size", "size", "m"}, s.size);
        visit({"offset", "offset", "m"}, s.offset);
        visit({"performer", "performer"}, s.performer);
        visit({"performer_size", "performer_size", "m"}, s.performer_size);
        visit({"told", "told"}, s.told);
        visit({"group", "group"}, s.group);
    }
    /// Compares all members.
    friend bool operator==(const BoardDetector&, const BoardDetector&) = default;
};

/// Breadcrumbs: which copies a robot still has to drop.
struct BoardSupply {
    std::string carrier;            ///< the robot that drops them
    int supply = 0;                 ///< which of its BreadcrumbsSpec, from 0
    std::string told;               ///< name of the board's channel that takes the number that is left
    Pose X_MC;                      ///< where a crumb appears, in the carrier's frame
    std::vector<BoardWord> crumbs;  ///< names of the copies, in the order in which they are dropped
    int limit = -1;                 ///< copies at most, as written; negative: none
    bool is_static = false;         ///< whether the carrier is scenery, at X_WM
    Pose X_WM;                      ///< pose of a static carrier

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"carrier", "carrier"}, s.carrier);
        visit({"supply", "supply"}, s.supply);
        visit({"told", "told"}, s.told);
        visit({"X_MC", "pose_in_carrier"}, s.X_MC);
        visit({"crumbs", "crumbs"}, s.crumbs);
        visit({"limit", "limit"}, s.limit);
        visit({"is_static", "is_static"}, s.is_static);
        visit({"X_WM", "pose"}, s.X_WM);
    }
    /// Compares all members.
    friend bool operator==(const BoardSupply&, const BoardSupply&) = default;
};

/// A sensor whose readings are messages that start others.
struct BoardSensor {
    std::string topic;   ///< of the sensor
    std::string model;   ///< that has it
    std::string sensor;  ///< its name
    std::string link;    ///< that carries it
    double rate = 0;     ///< Hz; 0: it is read at every observation

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"topic", "topic"}, s.topic);
        visit({"model", "model"}, s.model);
        visit({"sensor", "sensor"}, s.sensor);
        visit({"link", "link"}, s.link);
        visit({"rate", "rate", "Hz"}, s.rate);
    }
    /// Compares all members.
    friend bool operator==(const BoardSensor&, const BoardSensor&) = default;
};

/// A number in the memory of an on-board controller whose changes are messages.
struct BoardReport {
    std::string model;   ///< whose controller it is
    int kind = 0,        ///< OnboardKind::number of the controller
        controller = 0,  ///< which of the model's controllers of that kind, from 0
        place = 0;       ///< in its memory
    std::string told;    ///< name of the board's channel that takes the message

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"model", "model"}, s.model);
        visit({"kind", "kind"}, s.kind);
        visit({"controller", "controller"}, s.controller);
        visit({"place", "place"}, s.place);
        visit({"told", "told"}, s.told);
    }
    /// Compares all members.
    friend bool operator==(const BoardReport&, const BoardReport&) = default;
};

/// FollowActor: an actor, and the model whose position is sent to it.
struct BoardFollower {
    std::string actor,       ///< the robot that follows
        target;              ///< the model that it follows
    bool is_static = false;  ///< whether the target is scenery, at X_WM
    Pose X_WM;               ///< pose of a static target

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"actor", "actor"}, s.actor);
        visit({"target", "target"}, s.target);
        visit({"is_static", "is_static"}, s.is_static);
        visit({"X_WM", "pose"}, s.X_WM);
    }
    /// Compares all members.
    friend bool operator==(const BoardFollower&, const BoardFollower&) = default;
};

/// A board, its topics, and what reacts to messages.
struct MessageBoardSpec {
    std::vector<BoardTopic> topics;        ///< its channels
    std::vector<BoardWord> words;          ///< texts in messages, numbered from 1
    std::vector<BoardTrigger> triggers;    ///< in the order of the file
    std::vector<BoardTouch> touches;       ///< in the order of the file
    std::vector<BoardDetector> detectors;  ///< in the order of the file
    std::vector<BoardSupply> supplies;     ///< of breadcrumbs
    std::vector<BoardSensor> sensors;      ///< whose readings start triggers
    std::vector<BoardReport> reports;      ///< of controllers
    std::vector<BoardFollower> followers;  ///< actors that follow models

    /// What this kind states about itself. No plugin of this name exists.
    static constexpr OnboardKind kKind{
        .number = 91, .name = "message-board", .phrase = "a message board", .classes = "", .files = ""};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"topics", "topics"}, s.topics);
        visit({"words", "words"}, s.words);
        visit({"triggers", "triggers"}, s.triggers);
        visit({"touches", "touches"}, s.touches);
        visit({"detectors", "detectors"}, s.detectors);
        visit({"supplies", "supplies"}, s.supplies);
        visit({"sensors", "sensors"}, s.sensors);
        visit({"reports", "reports"}, s.reports);
        visit({"followers", "followers"}, s.followers);
    }
    /// The messages that it takes.
    std::vector<Channel> channels() const;
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>&) const {}
    /// Compares all members.
    friend bool operator==(const MessageBoardSpec&, const MessageBoardSpec&) = default;
};

}  // namespace roboss
