// Tables: topics(id, name, type, serialization_format, ...), messages(id, topic_id, timestamp in ns, data).
#include "bags/db3_reader.h"

#include <map>

#include "journal/database.h"

namespace roboss::bags {

namespace {

constexpr std::int64_t kMostMessageBytes = std::int64_t{1} << 30;  // of a message

Error bad_row(const std::string& what) {
    return {what, "record it again", "bad-record"};
}

/// Columns are of any type, whatever the table says.
const std::int64_t* number(const Row& row, std::size_t column) {
    return std::get_if<std::int64_t>(&row[column]);
}
const std::string* text(const Row& row, std::size_t column) {
    return std::get_if<std::string>(&row[column]);
}

/// A view could compute what it likes, for any time.
Result<> check_tables(const Database& database) {
    const auto tables = database.select(
        "SELECT name FROM sqlite_master WHERE type = 'table' AND name IN ('topics', 'messages') "
        "AND sql NOT LIKE '%VIRTUAL%'");
    if (!tables) return tables.error();
    if (tables.value().size() == 2) return Ok{};
    return Error{"this SQLite file has no tables of a rosbag2",
                 "give a bag of ROS 2; of a journal: `roboss journal export FILE --orders`", "not-a-bag"};
}

/// Topics in the intake, by their ids in the file.
Result<std::map<std::int64_t, std::size_t>> read_topics(const Database& database, Intake& intake) {
    std::map<std::int64_t, std::size_t> topics;
    const Result<> read = database.each(
        "SELECT id, name, type, serialization_format FROM topics ORDER BY id", {}, [&](Row row) -> Result<> {
            if (number(row, 0) == nullptr || text(row, 1) == nullptr || text(row, 2) == nullptr ||
                text(row, 3) == nullptr)
                return bad_row("a row of its table of topics is damaged");
            topics[*number(row, 0)] = intake.add_topic(*text(row, 1), *text(row, 2), *text(row, 3));
            return Ok{};
        });
    if (!read) return read.error();
    return topics;
}

}  // namespace

Result<> read_db3(Intake& intake) {
    const Result<Database> database = Database::open_read(intake.file());
    if (!database) return database.error();
    if (const Result<> fine = check_tables(database.value()); !fine) return fine.error();
    const auto topics = read_topics(database.value(), intake);
    if (!topics) return topics.error();
    std::string wanted;
    for (const auto& [id, topic] : topics.value())
        if (intake.is_wanted(topic)) wanted += (wanted.empty() ? "" : ",") + std::to_string(id);
    // Only the times of other topics count, so their bytes stay on the disk. A damaged length is not
    // believed.
    return database.value().each(
        "SELECT id, topic_id, timestamp, CASE WHEN topic_id NOT IN (" + wanted +
            ") THEN x'' WHEN length(data) <= ? THEN data ELSE 0 END FROM messages ORDER BY id",
        {kMostMessageBytes}, [&](Row row) -> Result<> {
            const std::int64_t* const id = number(row, 0);
            const std::string name = id == nullptr ? "a message" : "the message of id " + std::to_string(*id);
            if (number(row, 1) == nullptr || number(row, 2) == nullptr)
                return bad_row(name + ": its row is damaged");
            const auto topic = topics.value().find(*number(row, 1));
            if (topic == topics.value().end()) return bad_row(name + " is of a topic that is not described");
            const Blob* const bytes = std::get_if<Blob>(&row[3]);
            if (bytes == nullptr) return bad_row(name + " has no bytes, or more than 1 GiB");
            return intake.add(topic->second, static_cast<std::uint64_t>(*number(row, 2)), *bytes);
        });
}

}  // namespace roboss::bags
