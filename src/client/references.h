// How calls of a Client name a robot, link, joint or sensor: by its id or by its name in the world file.
#pragma once

#include <concepts>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "core/result.h"
#include "core/types.h"

namespace roboss {

/// An id or a name. It does not own the name: pass it to a call, do not keep it.
template <class Id>
class Reference {
  public:
    /// By id.
    Reference(Id id) : id_(id) {}
    /// By name: a string literal, std::string or std::string_view.
    template <class Name>
    requires std::convertible_to<const Name&, std::string_view> Reference(const Name& name)
        : name_(name), named_(true) {}

    bool named() const { return named_; }            ///< by name; else by id
    Id id() const { return id_; }                    ///< of one by id
    std::string_view name() const { return name_; }  ///< of one by name

  private:
    Id id_{};
    std::string_view name_;
    bool named_ = false;
};

/// A robot of the world.
using RobotRef = Reference<RobotId>;
/// A link of a robot.
using LinkRef = Reference<LinkId>;
/// A joint of a robot.
using JointRef = Reference<JointId>;

/// A sensor of a robot, by its index in RobotType::sensors or by its name.
class SensorRef {
  public:
    /// By index.
    template <std::integral Index>
    SensorRef(Index index) : index_(static_cast<std::size_t>(index)) {}
    /// By name.
    template <class Name>
    requires std::convertible_to<const Name&, std::string_view> SensorRef(const Name& name)
        : name_(name), named_(true) {}

    bool named() const { return named_; }            ///< by name; else by index
    std::size_t index() const { return index_; }     ///< of one by index
    std::string_view name() const { return name_; }  ///< of one by name

  private:
    std::size_t index_ = 0;
    std::string_view name_;
    bool named_ = false;
};

/// What became of an order. It may be ignored: the run reports every kind of refusal once, with the name of
/// the Client.
class OrderResult : public Result<> {
  public:
    /// From the check of an order.
    OrderResult(Result<> result) : Result<>(std::move(result)) {}
    /// Refused.
    OrderResult(Error error) : Result<>(std::move(error)) {}
    /// @throws std::runtime_error with the reason if the order was refused. In a control program that is not
    /// caught it ends the run.
    void value() const {
        if (!ok()) throw std::runtime_error(error().text());
    }
};

}  // namespace roboss
