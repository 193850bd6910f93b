#include "viewer/job_queue.hpp"

#include <algorithm>
#include <atomic>
#include <exception>

#include "base/error.hpp"

namespace cleancolor {

struct JobQueue::Entry {
  Job job;           // of the worker alone
  JobStatus status;  // guarded by the queue's mutex
  std::atomic<bool> cancelled = false;
};

JobQueue::~JobQueue() {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, entry] : entries_) entry->cancelled = true;
}

std::optional<int> JobQueue::add(Job job) {
  const std::lock_guard lock(mutex_);
  const auto waiting =
      std::ranges::count_if(entries_, [](const auto& e) { return e.second->status.state == JobStatus::State::queued; });
  if (std::size_t(waiting) >= most_waiting) return std::nullopt;
  const auto entry = std::make_shared<Entry>();
  entry->status.id = ++last_id_;
  entry->status.name = job.name;
  entry->job = std::move(job);
  entries_[last_id_] = entry;
  worker_.add([this, entry] { run(entry); });
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
  if (status.state == JobStatus::State::queued) status.state = JobStatus::State::cancelled;
  return true;
}

void JobQueue::run(const EntryHandle& entry) {
  {
    const std::lock_guard lock(mutex_);
    if (!entry->cancelled) entry->status.state = JobStatus::State::running;
  }
  std::string error;
  auto state = JobStatus::State::failed;
  try {
    if (!entry->cancelled) slice_job(entry);
    state = JobStatus::State::done;
  } catch (const std::bad_alloc&) {
    error = "out of memory";
  } catch (const std::exception& e) {  // also what is wrong with the meshes: the page shows it
    error = e.what();
  }
  end(entry, state, error);
  entry->job = {};  // the meshes may go
}

void JobQueue::slice_job(const EntryHandle& entry) {
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
  const Job& job = entry->job;
  const Summary summary = slice(job.request, progress);
  if (entry->cancelled) return;
  const auto print = prints_.add({.name = job.name,
                                  .file = job.output,
                                  .machine = {.printer = job.request.config},
                                  .azimuths = summary.protection.azimuths});
  if (!print) throw Error("there are too many prints; forget one and slice again");
  const std::lock_guard lock(mutex_);
  entry->status.print = print;
  entry->status.summary = summary;
  entry->status.progress = 1;
}

void JobQueue::end(const EntryHandle& entry, JobStatus::State state, const std::string& error) {
  const std::lock_guard lock(mutex_);
  entry->status.state = entry->cancelled ? JobStatus::State::cancelled : state;
  if (state == JobStatus::State::failed && !entry->cancelled) entry->status.error = error;
  std::vector<int> ended;
  for (const auto& [id, other] : entries_)
    if (other->status.ended()) ended.push_back(id);
  for (std::size_t i = 0; i + most_ended < ended.size(); ++i) entries_.erase(ended[i]);
}

}  // namespace cleancolor
