#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace cleancolor {
namespace {

/// Runs `work` on this thread and threads - 1 others; throws the first exception after all have stopped.
template <class Work>
void on_threads(int threads, Work work) {
  std::vector<std::jthread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(work);
  work();
}

class FirstException {
 public:
  void keep() {
    const std::lock_guard lock(mutex_);
    if (!exception_) exception_ = std::current_exception();
  }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr exception_;
};

/// Which stage of which index is due: the state that the threads of one stream share.
class Schedule {
 public:
  explicit Schedule(const Stream& stream) : stream_(stream), stages_(stream.stages.size()) {
    for (StageState& stage : stages_) stage.done.resize(std::size_t(stream.count));
  }

  /// What one thread does until all is done or someone failed.
  void work() {
    std::unique_lock lock(mutex_);
    while (!failed_ && consumed_ < stream_.count) {
      if (take_step(lock))
        changed_.notify_all();
      else
        changed_.wait(lock);
    }
    changed_.notify_all();
  }

  void rethrow() const { exception_.rethrow(); }

 private:
  struct StageState {
    int next = 0;        // the first index not begun
    int done_up_to = 0;  // all indices below are done
    std::vector<char> done;
  };

  /// Does the most urgent step: the serial end first, because it frees memory, then the later stages before the
  /// earlier.
  bool take_step(std::unique_lock<std::mutex>& lock) {
    if (!consuming_ && stages_.back().done_up_to > consumed_) {
      consuming_ = true;
      step(lock, stream_.consume, consumed_);
      consuming_ = false;
      ++consumed_;
      return true;
    }
    for (std::size_t s = stages_.size(); s-- > 0;) {
      StageState& stage = stages_[s];
      if (stage.next >= allowed(s)) continue;
      const int i = stage.next++;
      step(lock, stream_.stages[s].body, i);
      stage.done[std::size_t(i)] = 1;
      while (stage.done_up_to < stream_.count && stage.done[std::size_t(stage.done_up_to)]) ++stage.done_up_to;
      return true;
    }
    return false;
  }

  /// The first index that stage s may not begin yet.
  int allowed(std::size_t s) const {
    const Stage& stage = stream_.stages[s];
    const int ahead = int(std::min<std::int64_t>(stream_.count, std::int64_t(consumed_) + stage.ahead));
    if (s == 0) return std::min(ahead, consumed_ + stream_.window);
    const int before = stages_[s - 1].done_up_to;
    return std::min(ahead, before == stream_.count ? before : std::max(0, before - stage.reach));
  }

  void step(std::unique_lock<std::mutex>& lock, const std::function<void(int)>& body, int i) {
    lock.unlock();
    bool threw = false;
    try {
      body(i);
    } catch (...) {
      exception_.keep();
      threw = true;
    }
    lock.lock();
    failed_ = failed_ || threw;
  }

  const Stream& stream_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<StageState> stages_;
  int consumed_ = 0;
  bool consuming_ = false;
  bool failed_ = false;
  FirstException exception_;
};

}  // namespace

int thread_count(int threads) {
  return threads > 0 ? threads : std::max(1, int(std::thread::hardware_concurrency()));
}

void parallel_for(int count, int threads, const std::function<void(int)>& body) {
  std::atomic<int> next = 0;
  FirstException exception;
  on_threads(std::min(thread_count(threads), std::max(count, 1)), [&] {
    try {
      for (int i = next++; i < count; i = next++) body(i);
    } catch (...) {
      next = count;
      exception.keep();
    }
  });
  exception.rethrow();
}

void run(const Stream& stream, int threads) {
  assert(!stream.stages.empty());
  int reach = 0;  // of the stages after the one looked at
  for (auto stage = stream.stages.rbegin(); stage != stream.stages.rend(); ++stage) {
    assert(stage->ahead > reach);
    reach += stage->reach;
  }
  assert(stream.window > reach);
  (void)reach;
  Schedule schedule(stream);
  on_threads(thread_count(threads), [&] { schedule.work(); });
  schedule.rethrow();
}

}  // namespace cleancolor
