// The SQLite side of history.hpp: one table of runs, one of values.
#include <sqlite3.h>

#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "reports/figures.hpp"
#include "reports/history.hpp"
#include "reports/timing.hpp"

namespace broadside::reports {
namespace {

// "BSHI": marks a database as a history.
constexpr int kApplicationId = 0x42534849;
constexpr int kVersion = 1;

constexpr const char* kSchema =
    "CREATE TABLE run (id INTEGER PRIMARY KEY, at TEXT NOT NULL, build TEXT NOT NULL, rows TEXT NOT NULL UNIQUE);"
    "CREATE TABLE value (run INTEGER NOT NULL REFERENCES run, machine TEXT NOT NULL, scene TEXT NOT NULL, "
    "digest TEXT NOT NULL, label TEXT NOT NULL, metric TEXT NOT NULL, unit TEXT NOT NULL, value REAL NOT NULL);"
    "CREATE INDEX value_series ON value (machine, scene, label, metric, run);";

struct Close {
  void operator()(sqlite3* db) const { sqlite3_close(db); }
  void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
};
using Database = std::unique_ptr<sqlite3, Close>;
using Statement = std::unique_ptr<sqlite3_stmt, Close>;

core::Error error_of(sqlite3* db, const std::filesystem::path& file) {
  return {db != nullptr ? sqlite3_errmsg(db) : "out of memory", file.string(),
          "give a file that 'broadside history --add' made, or a new name in a folder that can be written"};
}

class Query {
 public:
  Query(sqlite3* db, const char* text) {
    sqlite3_stmt* made = nullptr;
    sqlite3_prepare_v2(db, text, -1, &made, nullptr);
    statement_.reset(made);
  }
  Query& with(const std::string& text) {
    sqlite3_bind_text(statement_.get(), ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    return *this;
  }
  Query& with(std::int64_t number) {
    sqlite3_bind_int64(statement_.get(), ++bound_, number);
    return *this;
  }
  Query& with(double number) {
    sqlite3_bind_double(statement_.get(), ++bound_, number);
    return *this;
  }
  // Returns SQLITE_ROW, SQLITE_DONE or an error.
  int step() { return statement_ ? sqlite3_step(statement_.get()) : SQLITE_ERROR; }
  [[nodiscard]] std::string text(int column) const {
    const auto* bytes = sqlite3_column_text(statement_.get(), column);
    return bytes == nullptr ? "" : reinterpret_cast<const char*>(bytes);
  }
  [[nodiscard]] std::int64_t number(int column) const { return sqlite3_column_int64(statement_.get(), column); }
  [[nodiscard]] double real(int column) const { return sqlite3_column_double(statement_.get(), column); }

 private:
  Statement statement_;
  int bound_ = 0;
};

std::int64_t pragma(sqlite3* db, const char* text) {
  Query query(db, text);
  return query.step() == SQLITE_ROW ? query.number(0) : -1;
}

core::Result<Database> open(const std::filesystem::path& file, int flags) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    return core::Error{"is a folder, and a history is one file", file.string(),
                       "give the file; a run's folder is appended with --add"};
  sqlite3* made = nullptr;
  const int status = sqlite3_open_v2(file.c_str(), &made, flags, nullptr);
  Database db(made);
  if (status != SQLITE_OK) return error_of(db.get(), file);
  // When two runs end at once, one waits for the other.
  sqlite3_busy_timeout(db.get(), 10'000);
  const std::int64_t id = pragma(db.get(), "PRAGMA application_id");
  if (id < 0) return error_of(db.get(), file);
  const bool is_fresh = id == 0 && pragma(db.get(), "SELECT count(*) FROM sqlite_master") == 0;
  if (!is_fresh && id != kApplicationId)
    return core::Error{"is a database, but no history of runs", file.string(), "give another file name"};
  if (!is_fresh && pragma(db.get(), "PRAGMA user_version") != kVersion)
    return core::Error{"is a history of another version than " + std::to_string(kVersion), file.string(),
                       "start a new file, or use the program that wrote this one"};
  if (is_fresh && (flags & SQLITE_OPEN_CREATE) == 0)
    return core::Error{"holds no run", file.string(), "append one with 'broadside history FILE --add DIR'"};
  return db;
}

struct Value {
  const core::Stamp* stamp;
  std::string metric;
  std::string unit;
  double value;
};

std::vector<Value> values_of(const core::RunRows& rows, const std::vector<Timing>& timings) {
  std::vector<Value> values;
  for (const core::Cell& cell : rows.cells) {
    if (cell.state != core::CellState::kRecorded) continue;
    for (const auto& [name, count] : cell.counters)
      values.push_back({&cell.stamp, "counter " + name, "", static_cast<double>(count)});
  }
  std::map<std::tuple<std::string, std::string, std::string>, Value> failed;
  for (const core::CellVerdicts& judged : rows.verdicts) {
    const core::Stamp& s = judged.stamp;
    Value& value =
        failed.try_emplace({s.machine, s.scene_name, s.label()}, Value{&s, "verdicts failed", "", 0.0}).first->second;
    for (const core::Verdict& v : judged.verdicts) value.value += v.outcome == core::Outcome::kFail ? 1.0 : 0.0;
  }
  for (auto& [key, value] : failed) values.push_back(std::move(value));
  for (const Timing& timing : timings) {
    if (!timing.admission.is_admitted || !std::isfinite(timing.frame.median)) continue;
    values.push_back({&timing.stamp, "median frame", "s", timing.frame.median});
    for (const StageTiming& stage : timing.stages)
      if (std::isfinite(stage.seconds.median))
        values.push_back({&timing.stamp, "median " + stage.stage, "s", stage.seconds.median});
  }
  return values;
}

// The key that keeps a run from being appended twice: a hash of the values, the builds that they came from, and how
// long each recording took, which differs between any two recordings.
std::string name_of(const core::RunRows& rows, const std::vector<Value>& values) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a, 64 bit
  const auto add = [&](const std::string& text) {
    for (const char c : text + '\n') hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  };
  for (const core::Cell& cell : rows.cells) add(hexadecimal(std::bit_cast<std::uint64_t>(cell.wall_s)));
  for (const Value& v : values) {
    for (const std::string& text :
         {v.stamp->machine, v.stamp->scene_name, v.stamp->label(), v.stamp->broadside_build, v.metric})
      add(text);
    add(hexadecimal(std::bit_cast<std::uint64_t>(v.value)));
  }
  return hexadecimal(hash);
}

}  // namespace

core::Result<Appended> append_to_history(const std::filesystem::path& file, const core::RunRows& rows,
                                         const std::string& at) {
  const std::vector<Timing> timings = pool_samples(rows);
  const std::vector<Value> values = values_of(rows, timings);
  if (values.empty())
    return core::Error{"has nothing to add to the history: no counter, no verdict, no admitted time", "history",
                       "record, check and time a cell first"};
  auto opened = open(file, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  if (!opened) return opened.error();
  sqlite3* db = opened.value().get();
  const auto run = [&](const char* text) { return sqlite3_exec(db, text, nullptr, nullptr, nullptr) == SQLITE_OK; };
  // Closing a database with an open transaction rolls it back.
  if (!run("BEGIN IMMEDIATE")) return error_of(db, file);
  if (pragma(db, "PRAGMA application_id") != kApplicationId) {
    const std::string marks = "PRAGMA application_id = " + std::to_string(kApplicationId) +
                              "; PRAGMA user_version = " + std::to_string(kVersion) + ";";
    if (!run(marks.c_str()) || !run(kSchema)) return error_of(db, file);
  }
  const std::string name = name_of(rows, values);
  Query known(db, "SELECT id FROM run WHERE rows = ?");
  const int status = known.with(name).step();
  if (status == SQLITE_ROW) return Appended{false, static_cast<std::uint64_t>(known.number(0)), 0};
  if (status != SQLITE_DONE) return error_of(db, file);
  Query insert(db, "INSERT INTO run (at, build, rows) VALUES (?, ?, ?)");
  if (insert.with(at).with(values.front().stamp->broadside_build).with(name).step() != SQLITE_DONE)
    return error_of(db, file);
  const std::int64_t id = sqlite3_last_insert_rowid(db);
  for (const Value& v : values) {
    Query value(db, "INSERT INTO value VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
    value.with(id).with(v.stamp->machine).with(v.stamp->scene_name).with(hexadecimal(v.stamp->scene_digest));
    if (value.with(v.stamp->label()).with(v.metric).with(v.unit).with(v.value).step() != SQLITE_DONE)
      return error_of(db, file);
  }
  if (!run("COMMIT")) return error_of(db, file);
  return Appended{true, static_cast<std::uint64_t>(id), values.size()};
}

core::Result<std::vector<HistorySeries>> read_history(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    return core::Error{"no such file", file.string(), "append a run with 'broadside history FILE --add DIR'"};
  auto opened = open(file, SQLITE_OPEN_READONLY);
  if (!opened) return opened.error();
  sqlite3* db = opened.value().get();
  // A scene with the same name and another digest is another scene: its values start a new series.
  Query query(
      db,
      "SELECT v.machine, v.scene, v.digest, v.label, v.metric, v.unit, r.id, r.at, r.build, v.value FROM value v "
      "JOIN run r ON r.id = v.run ORDER BY v.machine, v.scene, v.digest, v.label, v.metric, r.id");
  std::vector<HistorySeries> all;
  std::string digest;
  int status = query.step();
  for (; status == SQLITE_ROW; status = query.step()) {
    const bool is_same = !all.empty() && all.back().machine == query.text(0) && all.back().scene == query.text(1) &&
                         digest == query.text(2) && all.back().label == query.text(3) &&
                         all.back().metric == query.text(4);
    if (!is_same)
      all.push_back({.machine = query.text(0),
                     .scene = query.text(1),
                     .label = query.text(3),
                     .metric = query.text(4),
                     .unit = query.text(5)});
    digest = query.text(2);
    all.back().points.push_back(
        {static_cast<std::uint64_t>(query.number(6)), query.text(7), query.text(8), query.real(9)});
  }
  if (status != SQLITE_DONE) return error_of(db, file);
  for (HistorySeries& series : all) {
    std::vector<double> values;
    for (const HistoryPoint& point : series.points) values.push_back(point.value);
    series.changes = change_points(values);
  }
  return all;
}

}  // namespace broadside::reports
