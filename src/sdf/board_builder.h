// Builds the message board of a world from the plugins that send and pass on messages.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>
#include "xml/source_file.h"

#include "onboard_kinds/message_board.h"
#include "sdf/crumb_conversion.h"
#include "sdf/message_text.h"
#include "world/world.h"

namespace roboss::sdf_import {

/// The topic with exactly one "/" in front.
std::string absolute(std::string topic);
/// The topic of this model: "{model}" is its name.
std::string with_model(std::string topic, const std::string& model);

/// Call add_performer(), then add_touch() and add_detector() of all models, then add_trigger(), then
/// finish(). What they return says why the plugin cannot run, to continue "plugin 'x' ..."; empty: it can.
class BoardBuilder {
  public:
    explicit BoardBuilder(World& world);

    void add_supply(const CrumbSupply& supply);
    /// The floors at which the elevators are.
    void add_elevators();
    /// Adds the actors that follow a model. Returns why some cannot, in whole sentences.
    std::vector<std::string> add_followers();
    void add_performer(const pugi::xml_node& performer);
    std::string add_touch(const pugi::xml_node& plugin, const ModelInstance& instance);
    std::string add_detector(const pugi::xml_node& plugin, const ModelInstance& instance);
    std::string add_trigger(const pugi::xml_node& plugin);
    /// Input topics of triggers that nothing in the world publishes: only orders of users do.
    std::vector<std::string> topics_of_users() const;
    /// Adds the board to the world, on a static model without shapes, if anything needs it.
    void finish();

  private:
    struct Performer {
        std::string name, model;
        Vec3 size;
    };

    double number_of(const std::string& text);
    std::vector<BoardValue> values_of(const std::vector<MessageField>& fields);
    std::string name_for(const std::string& topic, const std::string& model);
    BoardTopic& add_topic(const std::string& topic, const std::string& model);
    /// Makes sure that the topic has a place to be kept, with these values.
    void open_topic(const std::string& topic, const MessageType& type, const std::vector<BoardValue>& values);
    std::string add_match(const pugi::xml_node& match, const MessageType& type, BoardTrigger& trigger);
    std::string add_output(const pugi::xml_node& output, BoardTrigger& trigger);
    std::string add_service(const pugi::xml_node& service, BoardTrigger& trigger);
    std::string read_pose(const std::vector<MessageField>& fields, BoardOutput& output) const;
    bool has_model(const std::string& name) const;
    const ModelInstance* find_model(const std::string& name) const;
    bool has_input(const std::string& topic) const;
    void find_outputs();
    void add_sensors();
    void add_arrivals();
    void add_report(const ModelInstance& model, const OnboardKind& kind, int controller, int place,
                    const std::string& topic, const std::vector<BoardValue>& values);

    World& world_;
    MessageBoardSpec board_;
    std::vector<Performer> performers_;
    std::map<std::string, std::vector<std::string>> taken_;  // names of values of a command, by its topic
    std::set<std::string> outputs_;                          // topics of sensors and controllers
    std::map<std::string, double> words_;
    int groups_ = 0;
};

}  // namespace roboss::sdf_import
