// SQLite behind values.
#include "journal/database.h"

#include <sqlite3.h>

namespace roboss {

namespace {

constexpr int kBusy_ms = 5'000;  // for which a reader and a writer wait for each other

struct Finalize {
    void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

Statement prepare(sqlite3* db, const std::string& sql) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(db, sql.c_str(), -1, &statement, nullptr);
    return Statement(statement);
}

void bind(sqlite3_stmt* s, int at, const Value& value) {
    if (const auto* number = std::get_if<std::int64_t>(&value))
        sqlite3_bind_int64(s, at, *number);
    else if (const auto* text = std::get_if<std::string>(&value))
        sqlite3_bind_text(s, at, text->data(), static_cast<int>(text->size()), SQLITE_TRANSIENT);
    else if (const auto* blob = std::get_if<Blob>(&value))
        sqlite3_bind_blob64(s, at, blob->empty() ? static_cast<const void*>("") : blob->data(), blob->size(),
                            SQLITE_TRANSIENT);
}

Value column(sqlite3_stmt* s, int at) {
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(s, at));
    switch (sqlite3_column_type(s, at)) {
        case SQLITE_INTEGER:
            return static_cast<std::int64_t>(sqlite3_column_int64(s, at));
        case SQLITE_TEXT:
            return std::string(reinterpret_cast<const char*>(sqlite3_column_text(s, at)), size);
        default: {
            const auto* bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(s, at));
            return bytes == nullptr ? Blob{} : Blob(bytes, bytes + size);
        }
    }
}

}  // namespace

void Database::Close::operator()(sqlite3* db) const {
    sqlite3_close(db);
}

Error Database::error(const std::string& doing) const {
    return {path_ + ": " + doing + ": " + sqlite3_errmsg(db_.get()),
            "check the path, the permissions and the free space"};
}

Result<Database> Database::open_write(const std::string& path) {
    Database d;
    d.path_ = path;
    sqlite3* db = nullptr;
    const int rc = sqlite3_open_v2(path.c_str(), &db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
    d.db_.reset(db);
    if (rc != SQLITE_OK) return d.error("cannot write it");
    sqlite3_busy_timeout(db, kBusy_ms);
    return d;
}

Result<Database> Database::open_read(const std::string& path) {
    Database d;
    d.path_ = path;
    sqlite3* db = nullptr;
    const int rc = sqlite3_open_v2(path.c_str(), &db, SQLITE_OPEN_READONLY, nullptr);
    d.db_.reset(db);
    if (rc != SQLITE_OK) return d.error("cannot read it");
    sqlite3_busy_timeout(db, kBusy_ms);
    return d;
}

Result<> Database::run(const std::string& sql) {
    if (sqlite3_exec(db_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
        return error("cannot write it");
    return Ok{};
}

Result<> Database::insert(const std::string& sql, const std::vector<Row>& rows) {
    const Statement statement = prepare(db_.get(), sql);
    if (!statement) return error("cannot write it");
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) bind(statement.get(), static_cast<int>(i) + 1, row[i]);
        if (sqlite3_step(statement.get()) != SQLITE_DONE) return error("cannot write it");
        sqlite3_reset(statement.get());
    }
    return Ok{};
}

Result<std::vector<Row>> Database::select(const std::string& sql, const Row& parameters) const {
    std::vector<Row> rows;
    const Result<> done = each(sql, parameters, [&](Row row) -> Result<> {
        rows.push_back(std::move(row));
        return Ok{};
    });
    if (!done) return done.error();
    return rows;
}

Result<> Database::each(const std::string& sql, const Row& parameters,
                        const std::function<Result<>(Row)>& take) const {
    const Statement statement = prepare(db_.get(), sql);
    if (!statement) return error("cannot read it");
    for (std::size_t i = 0; i < parameters.size(); ++i)
        bind(statement.get(), static_cast<int>(i) + 1, parameters[i]);
    int rc = SQLITE_ROW;
    while ((rc = sqlite3_step(statement.get())) == SQLITE_ROW) {
        Row row;
        for (int i = 0; i < sqlite3_column_count(statement.get()); ++i)
            row.push_back(column(statement.get(), i));
        if (const Result<> taken = take(std::move(row)); !taken) return taken.error();
    }
    if (rc != SQLITE_DONE) return error("cannot read it");
    return Ok{};
}

}  // namespace roboss
