// viewer/print_store.hpp
//
// PrintStore: the prints that are looked at. Each is read in the background: first drawn, then audited.
//
// What stays of a print is what the page asks for: bytes that are ready to be sent. Its moves are forgotten when it is
// audited.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "audit/machine.hpp"
#include "base/progress.hpp"
#include "pipeline.hpp"
#include "viewer/files.hpp"
#include "viewer/worker.hpp"

namespace cleancolor {

struct PrintFile {
  std::string name;  // for people
  FileHandle file;
  MachineRequest machine = {};
  std::optional<Azimuths> azimuths = {};  // where the print was sliced here
};

using Bytes = std::shared_ptr<const std::string>;

/// What is known of a print at one moment.
struct PrintStatus {
  enum class State { reading, drawn, audited, failed };
  int id = 0;
  std::string name;
  State state = State::reading;
  std::string stage;    // "reading", "audit" ...
  double progress = 0;  // of the stage, in [0, 1]
  std::string error;    // where it failed
  Bytes summary;        // JSON; from drawn on, as is moves
  Bytes moves;
  Bytes audit;  // from audited on, as is audit_json
  Bytes audit_json;
  FileHandle file;
};

class PrintStore {
 public:
  static constexpr std::size_t most_prints = 64;
  static constexpr int most_unjudged = 2;  // so many are drawn ahead of the audit, for each is there as a whole

  /// threads: of each of both stages; 0: as many as the machine has. most_bytes: once so much is kept, no further print
  /// is taken.
  explicit PrintStore(int threads = 0, std::size_t most_bytes = 4'000'000'000)
      : threads_(threads), most_bytes_(most_bytes) {}
  ~PrintStore();

  /// Held for a print that is still to come: until then no other takes its place.
  using Room = std::shared_ptr<const int>;

  /// nullptr where there is no more room: of prints and rooms there are most_prints, or of bytes most_bytes.
  Room room();

  /// The id of the print; ids ascend from 1. Nothing where there is no room; with one there is.
  std::optional<int> add(PrintFile file, const Room& room = nullptr);

  /// By id.
  std::vector<PrintStatus> list() const;
  std::optional<PrintStatus> find(int id) const;

  /// Stops reading it, too. Returns whether there was one.
  bool forget(int id);

 private:
  struct Entry;
  using EntryHandle = std::shared_ptr<Entry>;
  struct Drawn;

  bool full() const;
  bool may_draw(const EntryHandle& entry);
  void draw(const EntryHandle& entry);
  void judge(const EntryHandle& entry, const std::shared_ptr<Drawn>& drawn);
  void guarded(const EntryHandle& entry, const std::function<void()>& work);
  Progress progress_of(const EntryHandle& entry);

  int threads_;
  std::size_t most_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable judged_;                    // or forgotten
  const Room rooms_ = std::make_shared<const int>();  // each room is one more holder
  int unjudged_ = 0;
  std::map<int, EntryHandle> entries_;
  int last_id_ = 0;
  Worker judging_;  // the last members, for they use all others; and drawing ends first, for it gives to judging
  Worker drawing_;
};

}  // namespace cleancolor
