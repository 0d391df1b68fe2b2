// See comms.h. Defaults are those of RFComms and Broker of gz-sim.
#include "sdf/comms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/number_text.h"

namespace roboss::sdf_import {
namespace {

constexpr const char* kComms = "RFComms|PerfectComms";
constexpr const char* kCommsFiles = "rf-comms-system|perfect-comms-system";
constexpr const char* kUsualBroker = "/broker/bind";

/// A plugin of the world, and the radios that it means.
struct Broker {
    std::string service;  // at which endpoints bind
    RadioSpec radio;
};

class CommsReader {
  public:
    CommsReader(World& world, const Import& import) : world_(world), import_(import) {}

    void read() {
        for (ExtensionElement& record : world_.extensions) {
            pugi::xml_document document;
            if (record.name != "plugin" || !document.load_string(record.text.c_str())) continue;
            const PluginName name = plugin_name({nullptr, document.document_element()});
            if (is_comms_plugin(name)) read_broker(record, name, document.document_element());
        }
        for (ModelSpec& model : world_.prototypes)
            for (LinkSpec& link : model.links)
                for (SensorSpec& sensor : link.sensors)
                    if (auto* radio = sensor.as<RadioSpec>(); radio && sensor.sdf_type == "plugin")
                        serve(sensor, *radio);
    }

  private:
    void read_broker(ExtensionElement& record, const PluginName& name, const pugi::xml_node& plugin) {
        Broker broker;
        const auto bind = plugin.child("broker").child("bind_service");
        broker.service = bind ? trimmed(bind.text().get()) : kUsualBroker;
        RadioSpec& radio = broker.radio;
        radio.is_perfect = name.class_name == "PerfectComms" || name.file == "perfect-comms-system";
        radio.collisions = false, radio.obstacle_loss = 0;
        radio.range = 50, radio.sigma = 10, radio.bit_rate = 54e6, radio.tx_power = 27;
        const auto range = plugin.child("range_config"), config = plugin.child("radio_config");
        number(record, range, "max_range", radio.range);
        if (!(radio.range > 0)) radio.range = std::numeric_limits<double>::infinity();
        number(record, range, "fading_exponent", radio.fading_exponent);
        number(record, range, "l0", radio.l0);
        number(record, range, "sigma", radio.sigma);
        number(record, config, "capacity", radio.bit_rate);
        number(record, config, "tx_power", radio.tx_power);
        number(record, config, "noise_floor", radio.noise_floor);
        const std::string modulation = trimmed(config.child("modulation").text().get());
        if (!modulation.empty() && modulation != "QPSK")
            import_.diagnostics().warning(
                record.where, "comms",
                "RFComms has the <modulation> '" + modulation + "'; it is taken as QPSK", "Write QPSK.");
        std::vector<SensorProblem> problems;
        radio.check(problems);
        for (const SensorProblem& problem : problems)
            import_.diagnostics().warning(
                record.where, "plugin-not-run",
                "plugin '" + record.plugin + "' " + problem.text + "; it is not run", problem.remedy);
        if (!problems.empty()) {
            record.reason = problems.front().text;
            return;
        }
        record.fate = PluginFate::kRuns;
        brokers_.push_back(std::move(broker));
    }

    void number(const ExtensionElement& record, const pugi::xml_node& block, const char* child,
                double& value) const {
        const auto node = block.child(child);
        if (!node) return;
        const std::string text = trimmed(node.text().get());
        const std::optional<double> number = parse_number(text);
        if (number && std::isfinite(*number))
            value = *number;
        else
            import_.diagnostics().warning(
                record.where, "bad-value",
                "<" + std::string(child) + "> is '" + text + "', which is no number",
                "Write a finite number.");
    }

    void serve(const SensorSpec& sensor, RadioSpec& radio) const {
        if (radio.broker.empty()) radio.broker = kUsualBroker;
        const auto broker = std::ranges::find(brokers_, radio.broker, &Broker::service);
        if (broker == brokers_.end()) {
            import_.diagnostics().warning(sensor.where, "comms",
                                          "no plugin of the world serves the CommsEndpoint '" +
                                              radio.address + "' (" + radio.broker +
                                              "); it gets the parameters of <roboss:radio>",
                                          "Add gz::sim::systems::RFComms or PerfectComms to the world.");
            return;
        }
        RadioSpec served = broker->radio;
        served.channel = radio.channel, served.address = radio.address, served.broker = radio.broker;
        radio = std::move(served);
    }

    World& world_;
    const Import& import_;
    std::vector<Broker> brokers_;
};

}  // namespace

bool is_comms_plugin(const PluginName& name) {
    return is_named(name, kComms, kCommsFiles);
}

void convert_comms(World& world, const Import& import) {
    CommsReader(world, import).read();
}

}  // namespace roboss::sdf_import
