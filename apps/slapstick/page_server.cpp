/// The explorer's file server. The HTTP library is used here and nowhere else.
#include "page_server.hpp"

#include <httplib.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <thread>
#include <vector>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* loopback = "127.0.0.1";

const char* type_of(const fs::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".html") return "text/html; charset=utf-8";
  if (ending == ".js") return "text/javascript; charset=utf-8";
  if (ending == ".css") return "text/css; charset=utf-8";
  if (ending == ".wasm") return "application/wasm";
  if (ending == ".json") return "application/json";
  return ending == ".svg" ? "image/svg+xml" : "application/octet-stream";
}

/// Does the request mean this server by a name of its own?
bool is_for_us(const httplib::Request& request, int port) {
  const std::string host = request.get_header_value("Host"), end = ":" + std::to_string(port);
  return host == loopback + end || host == "localhost" + end;
}

/// The file that a path stands for, or an empty path if the folder has no such file.
fs::path file_of(const fs::path& root, const std::string& path) {
  std::error_code failed;
  const fs::path wanted = fs::canonical(root / fs::path(path == "/" ? "index.html" : path.substr(1)), failed);
  if (failed || !fs::is_regular_file(wanted, failed)) return {};
  const auto [in_root, in_wanted] = std::mismatch(root.begin(), root.end(), wanted.begin(), wanted.end());
  return in_root == root.end() && in_wanted != wanted.end() ? wanted : fs::path();
}

void answer(const Served& served, const fs::path& root, const httplib::Request& request, httplib::Response& response) {
  response.set_header("Cache-Control", "no-cache");
  response.set_header("X-Content-Type-Options", "nosniff");
  if (request.path == "/opened.toml" && served.model) {
    response.set_content(served.model(), "text/plain; charset=utf-8");
    return;
  }
  const fs::path file = file_of(root, request.path);
  std::ifstream stream(file, std::ios::binary);
  if (file.empty() || !stream) {
    response.status = 404;
    return;
  }
  const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  response.set_content(bytes, type_of(file));
}

}  // namespace

std::string page_folder(const std::string& given) {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed).parent_path();
  std::vector<fs::path> places = {given};
  if (given.empty()) places = {program / "web", program / ".." / "share" / "slapstick" / "web"};
  for (const fs::path& place : places)
    if (fs::is_regular_file(place / "index.html", failed)) return fs::canonical(place).string();
  throw StorageError("no explorer in " + in_quotes(places.front().string()) +
                     ": `./dev web` builds one, and --page names its folder");
}

void serve_page(const Served& served, int port, const std::atomic<bool>& stop,
                const std::function<void(const std::string& address)>& ready) {
  httplib::Server server;
  // The library's own option, SO_REUSEPORT, would share a port with another explorer.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const fs::path root = fs::canonical(served.folder);
  int heard = port;
  server.set_pre_routing_handler([&heard](const httplib::Request& request, httplib::Response& response) {
    if (is_for_us(request, heard)) return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get(".*", [&](const httplib::Request& request, httplib::Response& response) {
    answer(served, root, request, response);
  });
  if (port == 0) heard = server.bind_to_any_port(loopback);
  if (heard < 0 || (port != 0 && !server.bind_to_port(loopback, port)))
    throw StorageError("port " + std::to_string(port) + " of " + loopback +
                       " cannot be listened to: choose another --port");
  std::promise<void> ended;
  std::thread listening([&server, &ended] {
    server.listen_after_bind();
    ended.set_value();
  });
  ready("http://" + std::string(loopback) + ":" + std::to_string(heard) + "/");
  while (!stop.load(std::memory_order_relaxed)) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  server.stop();
  // A client that sends its request byte by byte holds its thread, which the library cannot interrupt.
  if (ended.get_future().wait_for(std::chrono::seconds(1)) != std::future_status::ready) std::_Exit(done);
  listening.join();
}

}  // namespace slapstick::app
