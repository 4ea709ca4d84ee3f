#pragma once
/// What the fuzz targets share. A target makes of any bytes a value or one of the three errors of base/error.hpp;
/// anything else ends the program, which is how libFuzzer (./dev fuzz) and the replay of the corpus (replay.cpp) learn
/// of it.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "slapstick/base/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace slapstick::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Reports a promise that was broken.
inline void demand(bool kept, const char* promise, const std::string& what = "") {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n%s\n", promise, what.c_str());
  std::abort();
}

/// True if run() gave a value, false if it refused in one line.
template <class Run>
bool succeeds(const Run& run) {
  std::string message;
  try {
    run();
    return true;
  } catch (const InputError& error) {
    message = error.what();
  } catch (const NumericalError& error) {
    message = error.what();
  } catch (const StorageError& error) {  // MODEL is a file that is not there
    message = error.what();
  }
  demand(!message.empty() && message.find_first_of("\n\r") == std::string::npos, "a message is one line", message);
  return false;
}

}  // namespace slapstick::fuzz
