// See event_conversion.h.
#include "sdf/event_conversion.h"

#include <pugixml.hpp>
#include <utility>

#include "sdf/board_builder.h"

namespace roboss::sdf_import {
namespace {

/// A plugin that is kept in a world, read again.
class KeptPlugin {
  public:
    explicit KeptPlugin(ExtensionElement& record) : record_(record) {
        document_.load_string(record.text.c_str());
    }
    pugi::xml_node node() const { return document_.document_element(); }
    bool is_class(std::string_view name) const {
        const std::string written = record_.plugin;
        const std::size_t at = written.rfind("::");
        return record_.name == "plugin" && at != std::string::npos && written.substr(at + 2) == name;
    }
    bool is_undecided() const { return record_.fate == PluginFate::kNotRun && record_.reason.empty(); }

  private:
    pugi::xml_document document_;
    ExtensionElement& record_;
};

class EventConverter {
  public:
    EventConverter(World& world, Diagnostics& diagnostics)
        : world_(world), diagnostics_(diagnostics), builder_(world) {}

    void convert() {
        read_performers();
        for (const ModelInstance& instance : world_.instances)
            for (ExtensionElement& record : world_.prototypes[instance.prototype].extensions)
                convert_event(record, instance);
        for (ExtensionElement& record : world_.extensions) convert_trigger(record);
        std::vector<char> seen(world_.prototypes.size(), 0);
        for (const ModelInstance& instance : world_.instances) {
            if (std::exchange(seen[instance.prototype], 1) != 0) continue;
            for (ExtensionElement& record : world_.prototypes[instance.prototype].extensions)
                convert_trigger(record);
        }
        for (const ExtensionElement* record : warnings_)
            diagnostics_.warning(record->where, "plugin-not-run",
                                 "plugin '" + record->plugin + "' " + record->reason + "; it is not run",
                                 "docs/plugins.md says what it needs.");
        for (const std::string& topic : builder_.topics_of_users())
            diagnostics_.note({world_.file, 0}, "topic-of-users",
                              "nothing in the world publishes '" + topic + "', which starts other messages",
                              "Publish it with an order: docs/plugins.md, Messages.");
        builder_.finish();
    }

  private:
    void read_performers() {
        for (ExtensionElement& record : world_.extensions) {
            const KeptPlugin plugin(record);
            if (record.name != "plugin" || record.plugin.find("gz::sim") == std::string::npos ||
                plugin.is_class("TriggeredPublisher"))
                continue;
            for (const auto node : plugin.node().children("performer")) builder_.add_performer(node);
        }
    }

    void convert_event(ExtensionElement& record, const ModelInstance& instance) {
        const KeptPlugin plugin(record);
        if (plugin.is_class("TouchPlugin"))
            settle(record, builder_.add_touch(plugin.node(), instance));
        else if (plugin.is_class("PerformerDetector"))
            settle(record, builder_.add_detector(plugin.node(), instance));
    }

    void convert_trigger(ExtensionElement& record) {
        const KeptPlugin plugin(record);
        if (plugin.is_class("TriggeredPublisher")) settle(record, builder_.add_trigger(plugin.node()));
    }

    /// `fault`: why the plugin cannot run; empty: it can.
    void settle(ExtensionElement& record, const std::string& fault) {
        record.fate = fault.empty() ? PluginFate::kRuns : PluginFate::kNotRun;
        if (!fault.empty() && record.reason != fault) warnings_.push_back(&record);
        record.reason = fault;
    }

    World& world_;
    Diagnostics& diagnostics_;
    BoardBuilder builder_;
    std::vector<const ExtensionElement*> warnings_;
};

}  // namespace

void convert_events(World& world, Diagnostics& diagnostics) {
    EventConverter(world, diagnostics).convert();
}

}  // namespace roboss::sdf_import
