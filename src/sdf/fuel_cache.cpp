// Reads Fuel's addresses and looks into its caches.
#include "sdf/fuel_cache.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>

namespace roboss::sdf_import {
namespace {

namespace fs = std::filesystem;

constexpr const char* kServers[] = {"fuel.gazebosim.org", "fuel.ignitionrobotics.org"};  // one server

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::optional<int> parse_int(const std::string& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// The folder of this version, else of the highest one; the model's own folder if it has none.
fs::path version_in(const fs::path& model, std::optional<int> version) {
    fs::path newest = model;
    int highest = -1;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(model, ignored)) {
        const auto number = parse_int(entry.path().filename().string());
        if (!number || !entry.is_directory(ignored)) continue;
        if (version && number == version) return entry.path();
        if (*number > highest) highest = *number, newest = entry.path();
    }
    return newest;
}

}  // namespace

std::string percent_decoded(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        const char* digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
            result += static_cast<char>(value);
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

std::optional<fs::path> entry_named(const fs::path& folder, const std::string& name) {
    std::error_code ignored;
    if (fs::exists(folder / name, ignored)) return folder / name;
    const std::string wanted = lower_case(name);
    std::optional<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (lower_case(entry.path().filename().string()) != wanted) continue;
        // The order of a directory is not fixed: of several the first by name.
        if (!found || entry.path() < *found) found = entry.path();
    }
    return found;
}

std::optional<FuelUri> FuelUri::parse(const std::string& uri) {
    const std::size_t scheme = uri.find("://");
    if (scheme == std::string::npos) return std::nullopt;
    std::vector<std::string> words;
    for (const fs::path& word : fs::path(percent_decoded(uri.substr(scheme + 3))))
        if (!word.empty()) words.push_back(word.string());
    const auto models = std::find(words.begin(), words.end(), "models");
    if (models - words.begin() < 2 || words.end() - models < 2) return std::nullopt;
    FuelUri result;
    result.server = words.front();
    const auto owner =
        *(models - 1) == "fuel" ? models - 2 : models - 1;  // app.gazebosim.org/OWNER/fuel/models
    result.owner = *owner;
    auto next = models + 1;
    result.name = *next++;
    if (next != words.end() && (*next == "tip" || parse_int(*next))) result.version = parse_int(*next++);
    if (next != words.end() && *next == "files") ++next;
    for (; next != words.end(); ++next) result.file /= *next;
    return result;
}

fs::path FuelUri::model_in(const fs::path& cache) const {
    std::vector<std::string> servers{server};
    if (server.find("gazebosim.org") != std::string::npos || server.find("ignition") != std::string::npos)
        servers.insert(servers.end(), std::begin(kServers), std::end(kServers));
    for (const std::string& each : servers) {
        fs::path at = cache / each;
        bool found = true;
        for (const std::string& part : {owner, std::string("models"), name}) {
            const auto entry = entry_named(at, part);
            found = entry.has_value();
            if (!found) break;
            at = *entry;
        }
        if (found) return version_in(at, version);
    }
    return cache / server / lower_case(owner) / "models" / lower_case(name);
}

std::vector<fs::path> fuel_caches() {
    std::vector<fs::path> caches;
    for (const char* variable : {"GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"})
        if (const char* cache = std::getenv(variable)) caches.emplace_back(cache);
    if (const char* home = std::getenv("HOME")) {
        caches.push_back(fs::path(home) / ".gz" / "fuel");
        caches.push_back(fs::path(home) / ".ignition" / "fuel");
    }
    return caches;
}

}  // namespace roboss::sdf_import
