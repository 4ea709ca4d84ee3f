/// Writes the claims as JSON.
#include "io/json.hpp"
#include "reproduce/report.hpp"

namespace slapstick::paper {

std::string claims_json(const Options& options, const std::vector<Claim>& claims) {
  Json list = Json::list();
  for (const Claim& claim : claims) {
    Json quantities = Json::list();
    for (const Quantity& quantity : claim.quantities) {
      Json one = Json::object();
      one.set("name", quantity.name);
      if (!quantity.printed.empty()) one.set("printed", quantity.printed);
      one.set("computed", quantity.computed);
      if (quantity.value) one.set("value", *quantity.value);
      if (quantity.within) one.set("within", *quantity.within);
      if (!quantity.note.empty()) one.set("note", quantity.note);
      quantities.push(std::move(one));
    }
    Json one = Json::object();
    one.set("id", claim.id).set("printed", claim.printed).set("computed", claim.computed);
    one.set("agree", std::string(name(claim.agreement))).set("explanation", claim.explanation);
    one.set("quantities", std::move(quantities));
    list.push(std::move(one));
  }
  Json all = Json::object();
  all.set("version", SLAPSTICK_VERSION).set("model", "vibro-impact").set("quick", options.quick);
  all.set("claims", std::move(list));
  return all.dump() + "\n";
}

}  // namespace slapstick::paper
