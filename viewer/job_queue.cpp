#include "viewer/job_queue.hpp"

#include <algorithm>
#include <atomic>
#include <exception>

#include "base/error.hpp"

namespace cleancolor {

struct JobQueue::Entry {
  Job job;                // of the worker alone while it runs
  PrintStore::Room room;  // guarded by the queue's mutex, as is the status
  JobStatus status;
  std::atomic<bool> cancelled = false;
};

JobQueue::~JobQueue() {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, entry] : entries_) {
    entry->cancelled = true;
    if (entry->status.state == JobStatus::State::queued) drop(*entry, JobStatus::State::cancelled);
  }
}

std::optional<int> JobQueue::add(Job job, PrintStore::Room room) {
  const std::lock_guard lock(mutex_);
  const auto waiting =
      std::ranges::count_if(entries_, [](const auto& e) { return e.second->status.state == JobStatus::State::queued; });
  if (std::size_t(waiting) >= most_waiting) return std::nullopt;
  const auto entry = std::make_shared<Entry>();
  entry->status.id = ++last_id_;
  entry->status.name = job.name;
  entry->job = std::move(job);
  entry->room = std::move(room);
  entries_[last_id_] = entry;
  if (!working_) worker_.add([this] { run(); });
  working_ = true;
  return last_id_;
}

/// With its place in the queue.
JobStatus JobQueue::status(const Entry& entry) const {
  JobStatus status = entry.status;
  if (status.state == JobStatus::State::queued)
    status.position = int(std::ranges::count_if(
        entries_, [&](const auto& e) { return e.first < status.id && !e.second->status.ended(); }));
  return status;
}

std::vector<JobStatus> JobQueue::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<JobStatus> all;
  for (const auto& [id, entry] : entries_) all.push_back(status(*entry));
  return all;
}

std::optional<JobStatus> JobQueue::find(int id) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(id);
  if (found == entries_.end()) return std::nullopt;
  return status(*found->second);
}

bool JobQueue::remove(int id) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(id);
  if (found == entries_.end()) return false;
  JobStatus& status = found->second->status;
  if (status.ended()) {
    entries_.erase(found);
    return true;
  }
  found->second->cancelled = true;
  if (status.state == JobStatus::State::queued) {
    drop(*found->second, JobStatus::State::cancelled);
    forget_oldest();
  }
  return true;
}

/// Its files and its room may go.
void JobQueue::drop(Entry& entry, JobStatus::State state) {
  entry.status.state = state;
  entry.job = {};
  entry.room.reset();
}

void JobQueue::forget_oldest() {
  std::vector<int> ended;
  for (const auto& [id, entry] : entries_)
    if (entry->status.ended()) ended.push_back(id);
  for (std::size_t i = 0; i + most_ended < ended.size(); ++i) entries_.erase(ended[i]);
}

/// nullptr where none waits.
JobQueue::EntryHandle JobQueue::next() {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, entry] : entries_)
    if (entry->status.state == JobStatus::State::queued) {
      entry->status.state = JobStatus::State::running;
      return entry;
    }
  working_ = false;
  return nullptr;
}

void JobQueue::run() {
  while (const EntryHandle entry = next()) {
    std::optional<Summary> summary;
    std::string error;
    try {
      summary = sliced(entry);
    } catch (const std::bad_alloc&) {
      error = "out of memory";
    } catch (const std::exception& e) {  // also what is wrong with the meshes: the page shows it
      error = e.what();
    }
    end(entry, summary, error);
  }
}

Summary JobQueue::sliced(const EntryHandle& entry) {
  const Progress progress{.warn =
                              [&](const std::string& message) {
                                const std::lock_guard lock(mutex_);
                                std::vector<std::string>& all = entry->status.warnings;
                                if (std::ranges::find(all, message) == all.end()) all.push_back(message);
                              },
                          .advance =
                              [&](std::string_view stage, double done) {
                                const std::lock_guard lock(mutex_);
                                entry->status.stage = stage;
                                entry->status.progress = done;
                              },
                          .interrupted = [&] { return entry->cancelled.load(); }};
  return slice(entry->job.request, progress);
}

/// Whether it is done or cancelled is settled here, once: a job that was cancelled leaves no print.
void JobQueue::end(const EntryHandle& entry, const std::optional<Summary>& summary, const std::string& error) {
  const std::lock_guard lock(mutex_);
  auto state = JobStatus::State::failed;
  if (entry->cancelled) {
    state = JobStatus::State::cancelled;
  } else if (summary) {
    const Job& job = entry->job;
    state = JobStatus::State::done;
    entry->status.print = prints_.add({.name = job.name,
                                       .file = job.output,
                                       .machine = {.printer = job.request.config},
                                       .azimuths = summary->protection.azimuths},
                                      entry->room);
    entry->status.summary = summary;
    entry->status.progress = 1;
  } else {
    entry->status.error = error;
  }
  drop(*entry, state);
  forget_oldest();
}

}  // namespace cleancolor
