// Checkpoint files: tables meta(key, value), states(robot, bytes), orders(bytes), memory(client, bytes).
#include "journal/journal.h"

#include <bit>
#include <cstdio>
#include <filesystem>

#include "journal/database.h"
#include "wire/codec.h"

namespace roboss {

namespace {

constexpr std::int64_t kFormat = 1;
constexpr const char* kTables =
    "CREATE TABLE meta(key TEXT PRIMARY KEY, value);"
    "CREATE TABLE states(robot INTEGER PRIMARY KEY, bytes BLOB);"
    "CREATE TABLE orders(bytes BLOB);"
    "CREATE TABLE memory(client TEXT PRIMARY KEY, bytes BLOB);";
constexpr const char* kSaveAgain = "save the run again, or start without --from";

/// Everything beside the states, so that no damage goes unnoticed.
std::uint64_t rest_hash(const Blob& orders, const SavedRun& run) {
    const auto text = [](const Blob& b) {
        return std::string_view(reinterpret_cast<const char*>(b.data()), b.size());
    };
    Hash hash;
    hash.add(static_cast<std::uint64_t>(run.tick));
    hash.add(run.seed);
    hash.add(std::string_view(run.world_file));
    hash.add(text(orders));
    for (const auto& [client, memory] : run.memory) {
        hash.add(std::string_view(client));
        hash.add(std::string_view(memory));
    }
    return hash.value();
}

std::vector<Row> meta_rows(const Model& model, const SavedRun& run, const Blob& orders) {
    char dt[40];
    std::snprintf(dt, sizeof dt, "%.17g", model.dt_s);
    return {{std::string("format"), kFormat},
            {std::string("world_file"), run.world_file},
            {std::string("world"), model.name},
            {std::string("dt_s"), std::string(dt)},
            {std::string("model_hash"), to_hex(model.hash)},
            {std::string("robots"), static_cast<std::int64_t>(run.states.size())},
            {std::string("tick"), run.tick},
            {std::string("seed"), std::bit_cast<std::int64_t>(run.seed)},
            {std::string("state_hash"), to_hex(state_hash_of(model, run))},
            {std::string("rest_hash"), to_hex(rest_hash(orders, run))}};
}

Result<> write(const std::string& path, const Model& model, const SavedRun& run) {
    Result<Database> opened = Database::create(path);
    if (!opened) return opened.error();
    Database& db = opened.value();
    const Blob orders = encode_orders(run.orders);
    std::vector<Row> states, memory;
    for (std::size_t i = 0; i < run.states.size(); ++i) {
        Blob bytes;
        encode(run.states[i], bytes);
        states.push_back({static_cast<std::int64_t>(i), std::move(bytes)});
    }
    for (const auto& [client, bytes] : run.memory)
        memory.push_back({client, Blob(bytes.begin(), bytes.end())});
    if (Result<> r = db.run(std::string("BEGIN;") + kTables); !r) return r;
    if (Result<> r = db.insert("INSERT INTO meta VALUES(?,?)", meta_rows(model, run, orders)); !r) return r;
    if (Result<> r = db.insert("INSERT INTO states VALUES(?,?)", states); !r) return r;
    if (Result<> r = db.insert("INSERT INTO orders VALUES(?)", {{orders}}); !r) return r;
    if (Result<> r = db.insert("INSERT INTO memory VALUES(?,?)", memory); !r) return r;
    return db.run("COMMIT;");
}

/// The meta table, with answers of the expected type or a fault that is remembered.
class Meta {
  public:
    explicit Meta(const std::vector<Row>& rows) {
        for (const Row& row : rows)
            if (const auto* key = std::get_if<std::string>(&row[0])) values_[*key] = row[1];
    }
    template <class T>
    T get(const std::string& key) {
        const auto found = values_.find(key);
        if (found != values_.end())
            if (const T* value = std::get_if<T>(&found->second)) return *value;
        if (missing_.empty()) missing_ = key;
        return T{};
    }
    const std::string& missing() const { return missing_; }

  private:
    std::map<std::string, Value> values_;
    std::string missing_;
};

Error damaged(const std::string& path, const std::string& what) {
    return {path + " is damaged: " + what, kSaveAgain};
}

/// Whether the file is a checkpoint of this world.
Result<> check_meta(const std::string& path, const Model& model, Meta& meta) {
    const auto format = meta.get<std::int64_t>("format");
    if (!meta.missing().empty()) return damaged(path, "it has no '" + meta.missing() + "'");
    if (format != kFormat)
        return Error{path + " has checkpoint format " + std::to_string(format) + ", this program reads " +
                         std::to_string(kFormat),
                     "use the version of RoBOSS that wrote it"};
    const auto hash = meta.get<std::string>("model_hash"), file = meta.get<std::string>("world_file");
    const auto dt = meta.get<std::string>("dt_s");
    if (!meta.missing().empty()) return damaged(path, "it has no '" + meta.missing() + "'");
    if (hash != to_hex(model.hash))
        return Error{path + " was saved from another world: " + file + ", step " + dt + " s, model hash " +
                         hash + "; this one has model hash " + to_hex(model.hash),
                     "give the world file, the step and the version of RoBOSS that it was saved with"};
    return Ok{};
}

Result<std::vector<RobotState>> read_states(const std::string& path, const Database& db, const Model& model) {
    Result<std::vector<Row>> rows = db.select("SELECT robot, bytes FROM states ORDER BY robot");
    if (!rows) return damaged(path, rows.error().message);
    if (rows.value().size() != model.robots.size())
        return damaged(path, "it has " + std::to_string(rows.value().size()) + " robots' states instead of " +
                                 std::to_string(model.robots.size()));
    std::vector<RobotState> states;
    for (std::size_t i = 0; i < rows.value().size(); ++i) {
        const Blob* bytes = std::get_if<Blob>(&rows.value()[i][1]);
        if (bytes == nullptr)
            return damaged(path, "the state of robot " + std::to_string(i) + " is not a blob");
        Result<RobotState> state = decode_state(*bytes, model.type_of(RobotId(i)));
        if (!state) return damaged(path, "robot '" + model.robots[i].name + "': " + state.error().message);
        states.push_back(std::move(state).value());
    }
    return states;
}

Result<Blob> read_rest(const std::string& path, const Database& db, const Model& model, SavedRun& run) {
    Result<std::vector<Row>> orders = db.select("SELECT bytes FROM orders");
    Result<std::vector<Row>> memory = db.select("SELECT client, bytes FROM memory");
    if (!orders || !memory) return damaged(path, (orders ? memory : orders).error().message);
    if (orders.value().size() != 1 || !std::holds_alternative<Blob>(orders.value()[0][0]))
        return damaged(path, "its orders are missing");
    for (const Row& row : memory.value()) {
        const auto* client = std::get_if<std::string>(&row[0]);
        const auto* bytes = std::get_if<Blob>(&row[1]);
        if (client == nullptr || bytes == nullptr)
            return damaged(path, "a Client's memory is of the wrong type");
        run.memory[*client] = std::string(bytes->begin(), bytes->end());
    }
    Blob bytes = std::get<Blob>(orders.value()[0][0]);
    Result<std::vector<Order>> decoded = decode_orders(bytes);
    if (!decoded) return damaged(path, decoded.error().message);
    run.orders = std::move(decoded).value();
    for (const Order& order : run.orders)
        if (Result<> checked = check_order(model, order); !checked)
            return damaged(path, checked.error().message);
    return bytes;
}

}  // namespace

std::uint64_t state_hash_of(const Model& model, const SavedRun& run) {
    std::vector<std::uint64_t> hashes;
    for (std::size_t i = 0; i < run.states.size(); ++i)
        hashes.push_back(state_hash(RobotId(i), run.tick, run.states[i]));
    return world_hash(model.hash, hashes);
}

Result<> save_run(const std::string& path, const Model& model, const SavedRun& run) {
    const std::string beside = path + ".part";
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    if (Result<> written = write(beside, model, run); !written) {
        std::filesystem::remove(beside, ignored);
        return written;
    }
    std::error_code error;
    std::filesystem::rename(beside, path, error);
    if (error)
        return Error{"cannot rename " + beside + " to " + path + ": " + error.message(),
                     "check the path and the permissions"};
    return Ok{};
}

Result<SavedRun> load_run(const std::string& path, const Model& model) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        return Error{path + ": there is no such file", "give a file that --save wrote"};
    Result<Database> opened = Database::open_read(path);
    if (!opened) return opened.error();
    const Database& db = opened.value();
    Result<std::vector<Row>> rows = db.select("SELECT key, value FROM meta");
    if (!rows)
        return Error{path + " is not a checkpoint of RoBOSS, or is truncated: " + rows.error().message,
                     kSaveAgain};
    Result<std::vector<Row>> sound = db.select("PRAGMA integrity_check(1)");
    if (!sound || sound.value().size() != 1 || sound.value()[0][0] != Value(std::string("ok")))
        return damaged(path, "it is truncated or was changed");
    Meta meta(rows.value());
    if (Result<> fits = check_meta(path, model, meta); !fits) return fits.error();

    SavedRun run;
    run.world_file = meta.get<std::string>("world_file");
    run.tick = meta.get<std::int64_t>("tick");
    run.seed = std::bit_cast<std::uint64_t>(meta.get<std::int64_t>("seed"));
    const auto states_hash = meta.get<std::string>("state_hash"),
               others_hash = meta.get<std::string>("rest_hash");
    if (!meta.missing().empty()) return damaged(path, "it has no '" + meta.missing() + "'");
    Result<std::vector<RobotState>> states = read_states(path, db, model);
    if (!states) return states.error();
    run.states = std::move(states).value();
    Result<Blob> orders = read_rest(path, db, model, run);
    if (!orders) return orders.error();
    if (to_hex(state_hash_of(model, run)) != states_hash)
        return damaged(path, "its states do not have the hash that was saved");
    if (to_hex(rest_hash(orders.value(), run)) != others_hash)
        return damaged(path, "its orders or what goes with them do not have the hash that was saved");
    return run;
}

}  // namespace roboss
