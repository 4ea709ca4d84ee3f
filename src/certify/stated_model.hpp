#pragma once
/// A model and its contact coordinates as the head of a certificate: exact numbers, a record each.
#include <string>

#include "flow/compiled_system.hpp"

namespace slapstick::certify {

/// " 0x1.8p+0": a double to the last bit, as docs/reference/certificate.md wants it.
[[nodiscard]] std::string hex(double x);
/// " 7".
[[nodiscard]] std::string number(long long k);

/// What a model has that certificates do not state yet; "" if nothing.
[[nodiscard]] std::string not_stated(const Model& model);

/// The records from `slapstick-certificate` to the last `number`. @throws InputError for a model that is not stated
[[nodiscard]] std::string stated_model(const flow::CompiledSystem& system);

/// " open slip- off 2": the state of every contact.
[[nodiscard]] std::string stated_contacts(const mode::ContactStates& states);

}  // namespace slapstick::certify
