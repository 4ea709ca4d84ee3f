#pragma once
/// Serves the explorer's files to this machine's own browsers.
///
/// Only the loopback is listened to. A request for another host is refused, so that no page of another site reaches the
/// server by a name that points here (DNS rebinding); so is a path that leads out of the folder, by dots or by links.
/// Errors: StorageError as stated. Threads: requests are answered by threads of the HTTP library.
#include <atomic>
#include <functional>
#include <string>

namespace slapstick::app {

struct Served {
  std::string folder;                  ///< with index.html
  std::function<std::string()> model;  ///< the text of the model that the page opens with; null: none
};

/// The folder of the page: the one given, or that of a build or an installation beside the program.
/// @throws StorageError if there is no page; it says how to build one
[[nodiscard]] std::string page_folder(const std::string& given);

/// Serves until `stop` is set, asked for ten times a second.
/// @param port  0: any that is free
/// @param ready  called with the address, "http://127.0.0.1:8123/", once requests are heard
/// @throws StorageError if the port cannot be had
void serve_page(const Served& served, int port, const std::atomic<bool>& stop,
                const std::function<void(const std::string& address)>& ready);

}  // namespace slapstick::app
