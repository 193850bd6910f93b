#include "viewer/connection.hpp"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

namespace cleancolor {
namespace {

constexpr int look_ms = 50;  // so often a wait looks whether the server stops
constexpr double fair_bytes_s = 16'000;
constexpr double linger_s = 1;

using Ends = int (*)(int, sockaddr*, socklen_t*);

/// end: getpeername or getsockname.
void ip_and_port(int socket, Ends end, std::string& ip, int& port) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  auto* const generic = reinterpret_cast<sockaddr*>(&address);
  if (end(socket, generic, &size) != 0 || getnameinfo(generic, size, host.data(), host.size(), service.data(),
                                                      service.size(), NI_NUMERICHOST | NI_NUMERICSERV) != 0)
    return;
  ip = host.data();
  port = std::atoi(service.data());
}

}  // namespace

bool Connection::wait(short event) {
  while (is_writable()) {
    pollfd waiting{socket_, event, 0};
    const auto since = std::chrono::steady_clock::now();
    const int ready = poll(&waiting, 1, look_ms);
    left_s_ -= std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
  return false;
}

void Connection::moved(ssize_t bytes) {
  left_s_ = std::min(patience_s_, left_s_ + double(bytes) / fair_bytes_s);
}

ssize_t Connection::read(char* bytes, std::size_t count) {
  if (begin_ == end_) {
    if (!wait(POLLIN)) return -1;
    const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (got <= 0) return got;
    moved(got);
    begin_ = 0;
    end_ = std::size_t(got);
  }
  const std::size_t some = std::min(count, end_ - begin_);
  std::memcpy(bytes, buffer_.data() + begin_, some);
  begin_ += some;
  return ssize_t(some);
}

ssize_t Connection::write(const char* bytes, std::size_t count) {
  for (std::size_t done = 0; done < count;) {
    if (!wait(POLLOUT)) return -1;
    const ssize_t sent = ::send(socket_, bytes + done, count - done, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) return -1;
    if (sent <= 0) continue;
    moved(sent);
    done += std::size_t(sent);
  }
  return ssize_t(count);
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip_and_port(socket_, getpeername, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  ip_and_port(socket_, getsockname, ip, port);
}

void Connection::close() {
  ::shutdown(socket_, SHUT_WR);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(linger_s);
  left_s_ = linger_s;
  while (std::chrono::steady_clock::now() < end && wait(POLLIN) &&
         ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT) > 0) {
  }
  ::close(socket_);
}

}  // namespace cleancolor
