/// Bytes as a certificate: slapstick-verify's reader and rules give a verdict, or say which line is not readable.
#include <sstream>

#include "target.hpp"
#include "verdict.hpp"

namespace slapstick::fuzz {
namespace {

void demand_one_line(const std::string& message) {
  demand(!message.empty() && message.find('\n') == std::string::npos, "a message is one line", message);
}

void check(std::string_view text) {
  std::istringstream in{std::string(text)};
  const verify::Verdict verdict = verify::check(in, [](long, const std::string& what) { demand_one_line(what); });
  demand_one_line(verify::sentence(verdict));
}

}  // namespace
}  // namespace slapstick::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slapstick::fuzz;
  try {
    check(text_of(data, size));
  } catch (const verify::Unreadable& error) {
    demand_one_line(error.what());
  }
  return 0;
}
