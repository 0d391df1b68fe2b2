// See event_conversion.h.
#include "sdf/event_conversion.h"

#include <utility>
#include "xml/source_file.h"

#include "sdf/board_builder.h"

namespace roboss::sdf_import {
namespace {

bool is_class(const ExtensionElement& record, std::string_view name) {
    const std::size_t at = record.plugin.rfind("::");
    return record.name == "plugin" && at != std::string::npos && record.plugin.substr(at + 2) == name;
}

/// A plugin that is kept in a world, read again.
class KeptPlugin {
  public:
    explicit KeptPlugin(const ExtensionElement& record) { document_.load_string(record.text.c_str()); }
    pugi::xml_node node() const { return document_.document_element(); }

  private:
    pugi::xml_document document_;
};

class EventConverter {
  public:
    EventConverter(World& world, Diagnostics& diagnostics)
        : world_(world), diagnostics_(diagnostics), builder_(world) {}

    void convert(const std::vector<CrumbSupply>& crumbs) {
        read_performers();
        for (const CrumbSupply& supply : crumbs) builder_.add_supply(supply);
        builder_.add_elevators();
        for (const std::string& fault : builder_.add_followers())
            diagnostics_.warning({world_.file, 0}, "plugin-not-run", fault, "Name a model of the world.");
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
            if (record->fate == PluginFate::kNotRun)
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
        for (const ExtensionElement& record : world_.extensions) {
            if (!is_class(record, "sim") && !is_class(record, "gazebo")) continue;
            const KeptPlugin plugin(record);
            for (const auto node : plugin.node().children("performer")) builder_.add_performer(node);
        }
    }

    void convert_event(ExtensionElement& record, const ModelInstance& instance) {
        if (is_class(record, "TouchPlugin"))
            settle(record, builder_.add_touch(KeptPlugin(record).node(), instance));
        else if (is_class(record, "PerformerDetector"))
            settle(record, builder_.add_detector(KeptPlugin(record).node(), instance));
    }

    void convert_trigger(ExtensionElement& record) {
        if (is_class(record, "TriggeredPublisher"))
            settle(record, builder_.add_trigger(KeptPlugin(record).node()));
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

void convert_events(World& world, const std::vector<CrumbSupply>& crumbs, Diagnostics& diagnostics) {
    EventConverter(world, diagnostics).convert(crumbs);
}

}  // namespace roboss::sdf_import
