// TOML to ClusterFile; every key is known or refused.
#include "app/cluster/cluster_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string_view>

#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

namespace roboss {
namespace {

constexpr std::int64_t kMostPerHost = 1024;

/// Collects what is wrong first; every getter after that gives a default.
class Reading {
  public:
    explicit Reading(std::string path) : path_(std::move(path)) {}

    void fail(const toml::node& at, const std::string& what, const std::string& remedy,
              const std::string& code) {
        if (!error_)
            error_ = Error{fmt::format("{}:{}: {}", path_, at.source().begin.line, what), remedy, code};
    }
    const std::optional<Error>& error() const { return error_; }

    void only(const toml::table& table, std::initializer_list<std::string_view> keys) {
        for (const auto& [key, value] : table) {
            if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
            std::string known;
            for (const std::string_view k : keys) known += (known.empty() ? "" : ", ") + std::string(k);
            fail(value, fmt::format("unknown key '{}'", key.str()), "known keys: " + known, "unknown-key");
        }
    }

    std::string text(const toml::table& table, const char* key, const std::string& otherwise) {
        const toml::node* node = table.get(key);
        if (node == nullptr) return otherwise;
        const auto value = node->value_exact<std::string>();
        if (!value)
            fail(*node, fmt::format("'{}' is not a string", key), fmt::format("write {} = \"...\"", key),
                 "wrong-type");
        return value.value_or(otherwise);
    }

    std::int64_t number(const toml::table& table, const char* key, std::int64_t otherwise,
                        std::int64_t most) {
        const toml::node* node = table.get(key);
        if (node == nullptr) return otherwise;
        const auto value = node->value_exact<std::int64_t>();
        if (!value || *value < 0 || *value > most)
            fail(*node, fmt::format("'{}' is not an integer from 0 to {}", key, most), "give such a number",
                 "wrong-type");
        return value.value_or(otherwise);
    }

    bool flag(const toml::table& table, const char* key) {
        const toml::node* node = table.get(key);
        if (node == nullptr) return false;
        const auto value = node->value_exact<bool>();
        if (!value)
            fail(*node, fmt::format("'{}' is neither true nor false", key),
                 fmt::format("write {} = true", key), "wrong-type");
        return value.value_or(false);
    }

    std::vector<std::string> texts(const toml::table& table, const char* key) {
        std::vector<std::string> values;
        const toml::node* node = table.get(key);
        if (node == nullptr) return values;
        const toml::array* array = node->as_array();
        if (array == nullptr) {
            fail(*node, fmt::format("'{}' is not a list of strings", key),
                 fmt::format("write {} = [\"...\", \"...\"]", key), "wrong-type");
            return values;
        }
        for (const toml::node& entry : *array) {
            const auto value = entry.value_exact<std::string>();
            if (!value)
                fail(entry, fmt::format("an entry of '{}' is not a string", key), "put it in quotes",
                     "wrong-type");
            values.push_back(value.value_or(""));
        }
        return values;
    }

    /// The tables of [[key]].
    std::vector<const toml::table*> tables(const toml::table& root, const char* key) {
        std::vector<const toml::table*> found;
        const toml::node* node = root.get(key);
        if (node == nullptr) return found;
        const toml::array* array = node->as_array();
        if (array == nullptr) {
            fail(*node, fmt::format("'{}' is not a list of tables", key),
                 fmt::format("write [[{}]], once for each", key), "wrong-type");
            return found;
        }
        for (const toml::node& entry : *array) {
            if (entry.as_table() == nullptr) {
                fail(entry, fmt::format("an entry of '{}' is not a table", key),
                     fmt::format("write [[{}]], once for each", key), "wrong-type");
                break;
            }
            found.push_back(entry.as_table());
        }
        return found;
    }

  private:
    std::string path_;
    std::optional<Error> error_;
};

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
}

/// Where members find the Controller: at its address, else under the name by which its host is reached.
std::string address_of_controller(Reading& read, const toml::table& controller, std::int64_t port) {
    const std::string host = read.text(controller, "host", "local"),
                      address = read.text(controller, "address", host == "local" ? "127.0.0.1" : host);
    return port == 0 ? address : fmt::format("{}:{}", address, port);
}

void add_controller(Reading& read, const toml::table& root, ClusterFile& file) {
    const toml::node* node = root.get("controller");
    const toml::table* table = node == nullptr ? nullptr : node->as_table();
    if (table == nullptr)
        return read.fail(root, "[controller] is missing", "add it with its host and world", "no-controller");
    read.only(*table, {"host", "world", "interface", "address", "port", "options"});
    const std::string world = read.text(*table, "world", "");
    if (world.empty())
        read.fail(*table, "[controller] has no world", "write world = \"city.sdf\", the path on that host",
                  "no-world");
    ClusterProcess process{"controller",
                           "controller",
                           read.text(*table, "host", "local"),
                           {"controller", world, "--log", "-"},
                           {}};
    const std::int64_t port = read.number(*table, "port", 0, 65'535);
    file.controller = address_of_controller(read, *table, port);
    if (const std::string interface = read.text(*table, "interface", ""); !interface.empty())
        append(process.network, {"--interface", interface});
    if (port > 0) append(process.network, {"--port", std::to_string(port)});
    append(process.arguments, read.texts(*table, "options"));
    file.processes.push_back(std::move(process));
}

void add_simulators(Reading& read, const toml::table& root, ClusterFile& file) {
    for (const toml::table* table : read.tables(root, "simulators")) {
        read.only(*table, {"host", "count", "threads", "options"});
        const std::string host = read.text(*table, "host", "local");
        const std::int64_t count = read.number(*table, "count", 1, kMostPerHost),
                           // A single one takes all cores of its host.
            threads = read.number(*table, "threads", count > 1 ? 1 : 0, kMostPerHost);
        for (std::int64_t i = 1; i <= count; ++i) {
            ClusterProcess process{"simulator", "", host, {"simulator"}, {"--controller", file.controller}};
            if (threads > 0) append(process.arguments, {"--threads", std::to_string(threads)});
            append(process.arguments, read.texts(*table, "options"));
            file.processes.push_back(std::move(process));
        }
    }
}

void add_clients(Reading& read, const toml::table& root, ClusterFile& file) {
    for (const toml::table* table : read.tables(root, "clients")) {
        read.only(*table, {"host", "program", "name", "options"});
        const std::string program = read.text(*table, "program", "");
        if (program.empty())
            read.fail(*table, "a client has no program",
                      "write program = \"driver.so\", the path on that host", "no-program");
        ClusterProcess process{"client",
                               "",
                               read.text(*table, "host", "local"),
                               {"client", program},
                               {"--controller", file.controller}};
        if (const std::string name = read.text(*table, "name", ""); !name.empty())
            append(process.arguments, {"--name", name});
        append(process.arguments, read.texts(*table, "options"));
        file.processes.push_back(std::move(process));
    }
}

/// HOST-1, HOST-2 ... in the order of the file.
void name_processes(std::vector<ClusterProcess>& processes) {
    std::map<std::string, int> numbers;
    for (ClusterProcess& process : processes)
        if (process.name.empty())
            process.name =
                fmt::format("{}-{}-{}", process.role, process.host, ++numbers[process.role + process.host]);
}

}  // namespace

Result<ClusterFile> load_cluster_file(const std::string& path) {
    const toml::parse_result parsed = toml::parse_file(path);
    Reading read(path);
    if (!parsed) {
        const toml::parse_error& e = parsed.error();
        if (e.source().begin.line == 0) return Error{path + " cannot be read", "check the path", "no-file"};
        return Error{fmt::format("{}:{}: {}", path, e.source().begin.line, e.description()),
                     "see https://toml.io for the syntax", "bad-toml"};
    }
    const toml::table& root = parsed.table();
    read.only(root, {"simulation", "program", "folder", "reach", "keys", "insecure", "controller",
                     "simulators", "clients"});
    ClusterFile file;
    file.path = path;
    file.simulation = read.text(root, "simulation", "default");
    file.program = read.text(root, "program", "roboss");
    file.folder = read.text(root, "folder", "");
    file.reach = read.texts(root, "reach");
    if (file.reach.empty())
        file.reach = {"ssh", "-o", "BatchMode=yes", "-o", "ConnectTimeout=10", "{host}", "sh", "-s"};
    file.insecure = read.flag(root, "insecure");
    file.keys = read.text(root, "keys", path + ".keys");
    add_controller(read, root, file);
    add_simulators(read, root, file);
    add_clients(read, root, file);
    if (read.error()) return *read.error();
    name_processes(file.processes);
    return file;
}

}  // namespace roboss
