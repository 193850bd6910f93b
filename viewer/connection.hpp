// viewer/connection.hpp
//
// Connection: the bytes of one request and its answer, of which neither a slow client nor the server's end waits long.
//
// A client has patience_s in store. Waiting for it uses them up; what it takes or sends in time gives them back, a
// second for each 16 kB, never more than there were. So none can stay by a trickle of bytes, and none that goes on at a
// fair pace is cut off, however much there is to move.
#pragma once

#include <httplib.h>

#include <array>
#include <atomic>

namespace cleancolor {

class Connection : public httplib::Stream {
 public:
  /// The socket and the flag must outlive it; stopping: ends every wait within a moment.
  Connection(int socket, double patience_s, const std::atomic<bool>& stopping)
      : socket_(socket), patience_s_(patience_s), left_s_(patience_s), stopping_(stopping) {}

  bool is_readable() const override { return begin_ < end_ || is_writable(); }
  bool is_writable() const override { return !stopping_ && left_s_ > 0; }
  /// -1 where nothing comes in time.
  ssize_t read(char* bytes, std::size_t count) override;
  /// All of them, or -1.
  ssize_t write(const char* bytes, std::size_t count) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

  /// Says that no more comes, and listens for a second at most until the client has closed: one that is still sending
  /// would else lose the answer.
  void close();

 private:
  bool wait(short event);
  void moved(ssize_t bytes);

  int socket_;
  double patience_s_, left_s_;
  const std::atomic<bool>& stopping_;
  std::array<char, 4096> buffer_;  // the library reads heads byte by byte
  std::size_t begin_ = 0, end_ = 0;
};

}  // namespace cleancolor
