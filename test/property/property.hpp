#pragma once
/// A law that every machine of a shape must obey, tried on many; one that breaks it is shrunk to the smallest that
/// does.
#include <functional>
#include <string>

#include "property/machine.hpp"

namespace slapstick::test {

/// What is wrong with a machine, "" if nothing. An exception breaks the law too.
using Law = std::function<std::string(const Machine&)>;

/// Fails the test of the caller with the smallest counterexample, as a model file. SLAPSTICK_CAMPAIGN=N tries N times
/// as many machines, SLAPSTICK_SEED=S others.
void expect_of_all(const Shape& shape, int count, const Law& law);

}  // namespace slapstick::test
