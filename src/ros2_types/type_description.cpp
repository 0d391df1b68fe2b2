// See type_description.h.
#include "ros2_types/type_description.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "core/hex.h"

namespace roboss::ros2 {

namespace {

/// Names of the primitive types by their number, as definitions have them.
constexpr std::array<std::string_view, 18> kPrimitives{
    "",       "",        "int8",    "uint8", "int16", "uint16", "int32", "uint32", "int64",
    "uint64", "float32", "float64", "",      "",      "",       "bool",  "byte",   "string"};

/// The text that the hash is of. Its spaces count.
std::string json_of(const TypeDescription& type) {
    std::string text = R"({"type_name": ")" + type.name + R"(", "fields": [)";
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
        const FieldDescription& field = type.fields[i];
        text += std::string(i == 0 ? "" : ", ") + R"({"name": ")" + field.name +
                R"(", "type": {"type_id": )" + std::to_string(field.type + field.container) +
                R"(, "capacity": )" + std::to_string(field.capacity) +
                R"(, "string_capacity": 0, "nested_type_name": ")" + field.nested + R"("}})";
    }
    return text + "]}";
}

/// "geometry_msgs/Pose" of "geometry_msgs/msg/Pose".
std::string short_name(const std::string& name) {
    const std::size_t slash = name.find('/');
    return name.substr(0, slash) + name.substr(name.rfind('/'));
}

std::string lines_of(const TypeDescription& type) {
    std::string text;
    for (const std::string& constant : type.constants) text += constant + "\n";
    for (const FieldDescription& field : type.fields) {
        if (field.name == kNoField) continue;
        text += field.type == kNested ? short_name(field.nested) : std::string(kPrimitives[field.type]);
        if (field.container == kSequence) text += "[]";
        if (field.container == kBounded) text += "[<=" + std::to_string(field.capacity) + "]";
        if (field.container == kArray) text += "[" + std::to_string(field.capacity) + "]";
        text += " " + field.name + "\n";
    }
    return text;
}

}  // namespace

std::string type_hash(const TypeDescription& type) {
    std::string text = R"({"type_description": )" + json_of(type) + R"(, "referenced_type_descriptions": [)";
    for (std::size_t i = 0; i < type.nested.size(); ++i)
        text += (i == 0 ? "" : ", ") + json_of(type.nested[i]);
    text += "]}";
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned bytes = 0;
    EVP_Digest(text.data(), text.size(), digest.data(), &bytes, EVP_sha256(), nullptr);
    return "RIHS01_" + hexadecimal(std::span(digest).first(bytes));
}

std::string constant_line(std::uint8_t type, const char* name, std::int64_t value) {
    return std::string(kPrimitives[type]) + " " + name + "=" + std::to_string(value);
}

std::string definition_text(const TypeDescription& type) {
    std::string text = lines_of(type);
    for (const TypeDescription& part : type.nested)
        text += std::string(80, '=') + "\nMSG: " + short_name(part.name) + "\n" + lines_of(part);
    return text;
}

std::string full_type_name(const std::string& type, const std::string& middle) {
    const std::size_t slash = type.find('/');
    if (slash == std::string::npos || type.find('/', slash + 1) != std::string::npos) return type;
    return type.substr(0, slash) + "/" + middle + type.substr(slash);
}

void add_nested(TypeDescription& type, TypeDescription part) {
    std::vector<TypeDescription> parts = std::move(part.nested);
    part.nested.clear();
    parts.push_back(std::move(part));
    for (TypeDescription& each : parts) {
        const auto at =
            std::lower_bound(type.nested.begin(), type.nested.end(), each.name,
                             [](const TypeDescription& t, const std::string& n) { return t.name < n; });
        if (at == type.nested.end() || at->name != each.name) type.nested.insert(at, std::move(each));
    }
}

}  // namespace roboss::ros2
