#include "fastdds/names.h"

#include <algorithm>

namespace roboss::fastdds {
namespace {

// "std_srvs/srv/Empty" and "_Request" become "std_srvs::srv::dds_::Empty_Request_".
std::string dds_type(const std::string& type, const char* part) {
    std::string text;
    std::size_t from = 0;
    for (std::size_t slash = type.find('/'); slash != std::string::npos; slash = type.find('/', from)) {
        text += type.substr(from, slash - from) + "::";
        from = slash + 1;
    }
    return text + "dds_::" + type.substr(from) + part + "_";
}

// The value of a key in "key=value;key=value;".
std::string_view value_of(std::string_view data, std::string_view key) {
    while (!data.empty()) {
        const std::string_view entry = data.substr(0, data.find(';'));
        if (entry.size() > key.size() && entry.starts_with(key) && entry[key.size()] == '=')
            return entry.substr(key.size() + 1);
        data.remove_prefix(std::min(data.size(), entry.size() + 1));
    }
    return {};
}

}  // namespace

DdsTopic message_topic(const std::string& topic, const std::string& type) {
    return {"rt" + topic, dds_type(type, "")};
}

DdsTopic request_topic(const std::string& service, const std::string& type) {
    return {"rq" + service + "Request", dds_type(type, "_Request")};
}

DdsTopic reply_topic(const std::string& service, const std::string& type) {
    return {"rr" + service + "Reply", dds_type(type, "_Response")};
}

std::string ros_topic(const std::string& name) {
    for (const char* prefix : {"rt/", "rq/", "rr/"})
        if (name.starts_with(prefix)) return name.substr(2);
    return name;
}

std::string ros_type(const std::string& type) {
    const std::size_t middle = type.find("dds_::");
    if (middle == std::string::npos || !type.ends_with('_')) return type;
    std::string text;
    for (const std::string& part : {type.substr(0, middle), type.substr(middle + 6)})
        for (std::size_t i = 0; i < part.size(); ++i)
            if (part.compare(i, 2, "::") == 0)
                text += '/', ++i;
            else
                text += part[i];
    text.pop_back();
    return text;
}

std::string user_data(const std::string& hash) {
    return hash.empty() ? "" : "typehash=" + hash + ";";
}

std::string hash_in(std::string_view user_data) {
    const std::string_view hash = value_of(user_data, "typehash");
    return hash.starts_with("RIHS01_") && hash.size() == 71 ? std::string(hash) : std::string();
}

bool is_cyclone_service(std::string_view user_data) {
    return !value_of(user_data, "serviceid").empty() || !value_of(user_data, "clientid").empty();
}

}  // namespace roboss::fastdds
