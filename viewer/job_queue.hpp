// viewer/job_queue.hpp
//
// JobQueue: slicing in the background, one job after the other. What comes out becomes a print of the store.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "pipeline.hpp"
#include "viewer/files.hpp"
#include "viewer/print_store.hpp"
#include "viewer/worker.hpp"

namespace cleancolor {

struct Job {
  std::string name;      // of the G-code, for people
  SliceRequest request;  // output: that of the file below
  std::vector<FileHandle> meshes;
  FileHandle output;
};

struct JobStatus {
  enum class State { queued, running, done, failed, cancelled };
  int id = 0;
  std::string name;
  State state = State::queued;
  int position = 0;  // so many jobs come before it
  std::string stage;
  double progress = 0;  // of the stage, in [0, 1]
  std::vector<std::string> warnings;
  std::string error;
  std::optional<int> print;  // id in the store, once done
  std::optional<Summary> summary;

  bool ended() const { return state != State::queued && state != State::running; }
};

class JobQueue {
 public:
  static constexpr std::size_t most_waiting = 16;
  static constexpr std::size_t most_ended = 64;  // older ones are forgotten

  explicit JobQueue(PrintStore& prints) : prints_(prints) {}
  ~JobQueue();

  /// The id of the job; ids ascend from 1. Nothing where too many wait.  Requires: room for its print.
  std::optional<int> add(Job job, PrintStore::Room room);

  /// By id.
  std::vector<JobStatus> list() const;
  std::optional<JobStatus> find(int id) const;

  /// Cancels a job that waits or runs, and forgets one that has ended. Returns whether there was one.
  bool remove(int id);

 private:
  struct Entry;
  using EntryHandle = std::shared_ptr<Entry>;

  void run();
  EntryHandle next();
  Summary sliced(const EntryHandle& entry);
  void end(const EntryHandle& entry, const std::optional<Summary>& summary, const std::string& error);
  void drop(Entry& entry, JobStatus::State state);
  void forget_oldest();
  JobStatus status(const Entry& entry) const;

  PrintStore& prints_;
  mutable std::mutex mutex_;
  std::map<int, EntryHandle> entries_;
  int last_id_ = 0;
  bool working_ = false;  // the worker looks for the next one by itself
  Worker worker_;         // the last member: it uses all others
};

}  // namespace cleancolor
