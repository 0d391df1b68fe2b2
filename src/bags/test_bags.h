// Bags as tests write them.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "bags/crc32.h"
#include "bags/mcap_reader.h"
#include "journal/database.h"

namespace roboss::bags::test {

/// A number in little-endian order.
template <class T>
std::string bytes_of(T value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}
inline std::string text_bytes(const std::string& text) {
    return bytes_of(static_cast<std::uint32_t>(text.size())) + text;
}

// Records of MCAP.
inline std::string record(int op, const std::string& content) {
    return static_cast<char>(op) + bytes_of(static_cast<std::uint64_t>(content.size())) + content;
}
inline std::string schema(std::uint16_t id, const std::string& type) {
    return record(3, bytes_of(id) + text_bytes(type) + text_bytes("ros2msg") + text_bytes("# its fields"));
}
inline std::string channel(std::uint16_t id, std::uint16_t schema, const std::string& topic,
                           const std::string& encoding = "cdr") {
    return record(
        4, bytes_of(id) + bytes_of(schema) + text_bytes(topic) + text_bytes(encoding) + text_bytes(""));
}
inline std::string message(std::uint16_t channel, std::uint64_t log_ns, const std::string& bytes) {
    return record(5, bytes_of(channel) + bytes_of(std::uint32_t{7}) + bytes_of(log_ns) +
                         bytes_of(std::uint64_t{1}) + bytes);
}
/// A chunk of `size` bytes, which are `packed` here.
inline std::string chunk(std::uint64_t size, std::uint32_t checksum, const std::string& compression,
                         const std::string& packed) {
    return record(6, bytes_of(std::uint64_t{0}) + bytes_of(std::uint64_t{0}) + bytes_of(size) +
                         bytes_of(checksum) + text_bytes(compression) +
                         bytes_of(static_cast<std::uint64_t>(packed.size())) + packed);
}
inline std::uint32_t checksum_of(const std::string& bytes) {
    return crc32({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}
/// A chunk of records without compression.
inline std::string chunk_of(const std::string& records) {
    return chunk(records.size(), checksum_of(records), "", records);
}
/// A file as its writer leaves it if it is interrupted.
inline std::string unfinished_mcap(const std::string& records) {
    return std::string(kMcapMagic) + record(1, text_bytes("ros2") + text_bytes("test")) + records;
}
/// A whole file.
inline std::string mcap(const std::string& records) {
    return unfinished_mcap(records) + record(15, bytes_of(std::uint32_t{0})) +
           record(2, std::string(20, '\0')) + std::string(kMcapMagic);
}

/// A topic of an SQLite file, and its messages.
struct Db3Topic {
    std::string name, type, encoding = "cdr";
};
struct Db3Message {
    std::int64_t topic = 1;  // from 1
    std::int64_t log_ns = 0;
    std::string bytes;
};

/// Writes an SQLite file as rosbag2 does.
inline Result<> write_db3(const std::string& path, const std::vector<Db3Topic>& topics,
                          const std::vector<Db3Message>& messages) {
    Result<Database> database = Database::open_write(path);
    if (!database) return database.error();
    for (const char* sql :
         {"CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
          "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)",
          "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT "
          "NULL, "
          "data BLOB NOT NULL)",
          "CREATE INDEX timestamp_idx ON messages (timestamp ASC)"})
        if (Result<> done = database.value().run(sql); !done) return done;
    std::vector<Row> rows;
    for (const Db3Topic& topic : topics)
        rows.push_back({static_cast<std::int64_t>(rows.size()) + 1, topic.name, topic.type, topic.encoding});
    if (Result<> done = database.value().insert("INSERT INTO topics VALUES (?, ?, ?, ?, '')", rows); !done)
        return done;
    rows.clear();
    for (const Db3Message& message : messages)
        rows.push_back({message.topic, message.log_ns, Blob(message.bytes.begin(), message.bytes.end())});
    return database.value().insert("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)", rows);
}

/// Takes all messages of topics that begin with `prefix`, each as the line TOPIC#NUMBER@TIME=BYTES.
class ListingSink : public Sink {
  public:
    explicit ListingSink(std::string prefix = "/") : prefix_(std::move(prefix)) {}
    bool wants(const Topic& topic) override { return topic.name.starts_with(prefix_); }
    Result<> take(const Topic& topic, const Message& message) override {
        std::string text(message.bytes.begin(), message.bytes.end());
        lines.push_back(topic.name + "#" + std::to_string(message.number) + "@" +
                        std::to_string(message.log_ns) + "=" + text);
        types.push_back(topic.type + " " + topic.encoding);
        return Ok{};
    }
    std::vector<std::string> lines, types;

  private:
    std::string prefix_;
};

}  // namespace roboss::bags::test
