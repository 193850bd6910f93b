#include "viewer/print_store.hpp"

#include <atomic>
#include <exception>
#include <limits>

#include "audit/audit.hpp"
#include "audit/report.hpp"
#include "base/error.hpp"
#include "reader/read.hpp"
#include "viewer/moves.hpp"
#include "viewer/places.hpp"
#include "viewer/summary.hpp"

namespace cleancolor {

struct PrintStore::Entry {
  PrintFile source;
  PrintStatus status;                 // guarded by the store's mutex, as are the warnings
  std::vector<std::string> warnings;  // of reading
  std::atomic<bool> forgotten = false;
};

/// What the audit needs of a print that is drawn.
struct PrintStore::Drawn {
  GcodePrint print;
  AuditMachine machine;
};

namespace {

Bytes bytes(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

}  // namespace

PrintStore::~PrintStore() {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, entry] : entries_) entry->forgotten = true;
  judged_.notify_all();
}

bool PrintStore::full() const {
  std::size_t kept = 0;
  for (const auto& [id, entry] : entries_)
    for (const Bytes& part :
         {entry->status.summary, entry->status.moves, entry->status.audit, entry->status.audit_json})
      kept += part ? part->size() : 0;
  return kept >= most_bytes_ || entries_.size() + std::size_t(rooms_.use_count() - 1) >= most_prints;
}

PrintStore::Room PrintStore::room() {
  const std::lock_guard lock(mutex_);
  return full() ? nullptr : rooms_;
}

std::optional<int> PrintStore::add(PrintFile file, const Room& room) {
  const std::lock_guard lock(mutex_);
  if (!room && full()) return std::nullopt;
  const auto entry = std::make_shared<Entry>();
  entry->status.id = ++last_id_;
  entry->status.name = file.name;
  entry->status.stage = "reading";
  entry->status.file = file.file;
  entry->source = std::move(file);
  entries_[last_id_] = entry;
  drawing_.add([this, entry] { draw(entry); });
  return last_id_;
}

std::vector<PrintStatus> PrintStore::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<PrintStatus> all;
  for (const auto& [id, entry] : entries_) all.push_back(entry->status);
  return all;
}

std::optional<PrintStatus> PrintStore::find(int id) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(id);
  if (found == entries_.end()) return std::nullopt;
  return found->second->status;
}

bool PrintStore::forget(int id) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(id);
  if (found == entries_.end()) return false;
  found->second->forgotten = true;
  entries_.erase(found);
  judged_.notify_all();
  return true;
}

Progress PrintStore::progress_of(const EntryHandle& entry) {
  return {.warn =
              [this, entry](const std::string& message) {
                const std::lock_guard lock(mutex_);
                entry->warnings.push_back(message);
              },
          .advance =
              [this, entry](std::string_view stage, double done) {
                const std::lock_guard lock(mutex_);
                entry->status.stage = stage;
                entry->status.progress = done;
              },
          .interrupted = [entry] { return entry->forgotten.load(); }};
}

/// A print that cannot be read has failed; the program goes on.
void PrintStore::guarded(const EntryHandle& entry, const std::function<void()>& work) {
  std::string error;
  try {
    work();
    return;
  } catch (const std::bad_alloc&) {
    error = "out of memory";
  } catch (const std::exception& e) {
    error = e.what();
  }
  const std::lock_guard lock(mutex_);
  entry->status.state = PrintStatus::State::failed;
  entry->status.error = error;
}

/// Waits until few enough are drawn and not audited. Returns whether the print is still wanted.
bool PrintStore::may_draw(const EntryHandle& entry) {
  std::unique_lock lock(mutex_);
  judged_.wait(lock, [&] { return entry->forgotten || unjudged_ < most_unjudged; });
  return !entry->forgotten;
}

void PrintStore::draw(const EntryHandle& entry) {
  if (!may_draw(entry)) return;
  guarded(entry, [&] {
    const Progress progress = progress_of(entry);
    const auto drawn = std::make_shared<Drawn>();
    GcodePrint& print = drawn->print;
    print = read_gcode(gcode_text(entry->source.file->path()), entry->source.name, progress);
    print.text.reset();  // the moves tell all that follows
    drawn->machine = audit_machine(print, entry->source.machine, progress);
    progress.advance("drawing", 0);
    const Timeline time = timeline(print, drawn->machine);
    const MoveArrays moves = move_arrays(print, drawn->machine, time, threads_);
    ReadPrint read{.print = &print, .machine = &drawn->machine, .time = &time, .moves = &moves};
    if (entry->source.machine.printer) read.printer = &*entry->source.machine.printer;
    if (entry->source.azimuths) read.azimuths = &*entry->source.azimuths;
    read.warnings = entry->warnings;  // only this thread adds to them as yet
    const Bytes summary = bytes(print_summary(read).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    const Bytes file = bytes(moves_file(moves));
    {
      const std::lock_guard lock(mutex_);
      entry->status.summary = summary;
      entry->status.moves = file;
      entry->status.state = PrintStatus::State::drawn;
      ++unjudged_;
    }
    judging_.add([this, entry, drawn] {
      judge(entry, drawn);
      const std::lock_guard lock(mutex_);
      --unjudged_;
      judged_.notify_all();
    });
  });
}

void PrintStore::judge(const EntryHandle& entry, const std::shared_ptr<Drawn>& drawn) {
  guarded(entry, [&] {
    AuditOptions options;
    options.threads = threads_;
    const Progress progress = progress_of(entry);
    const AuditResult result = audit(drawn->print, drawn->machine, options, progress);
    progress.advance("places", 0);
    const PlaceArrays places = place_arrays(drawn->print, drawn->machine, result, threads_);
    const Bytes file =
        bytes(places_file(places, result.scenarios.front().total, options.scenarios.front(), drawn->machine));
    const AuditedFile audited{.name = entry->source.name,
                              .print = &drawn->print,
                              .machine = &drawn->machine,
                              .result = &result,
                              .scenarios = &options.scenarios,
                              .warnings = entry->warnings};
    const Bytes json = bytes(audit_file_json(audited, {.places = std::numeric_limits<std::size_t>::max()}));
    const std::lock_guard lock(mutex_);
    entry->status.audit = file;
    entry->status.audit_json = json;
    entry->status.state = PrintStatus::State::audited;
    entry->status.progress = 1;
  });
}

}  // namespace cleancolor
