#pragma once
/// One run of a member of the catalogue, and what is noted of it.
#include "catalogue/member.hpp"

namespace slapstick::catalogue {

/// An event as it is compared with that of another run.
struct Seen {
  std::string kind, contact;
  Instant since_start;                  ///< period counted from the start's
  std::map<std::string, double> after;  ///< the state just after it, by name
};

struct Record {
  std::vector<Seen> events;
  Values values;
  std::string start_mode, mode;
};

/// How the run is to be made.
struct Way {
  SystemOptions options;
  double piece = 0.0;  ///< length of the pieces it is cut into; 0: not cut
};

/// @throws what the engine throws. Failed "each" expectations are reported to GoogleTest on the way.
Record run(const Member& member, const Way& way = {});

/// Kinds in their order, "impact slip- stick".
std::string kinds(const Record& record);

}  // namespace slapstick::catalogue
