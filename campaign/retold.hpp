#pragma once
/// What is true of a certificate's claim: its model run again by the engine, from its start to its end.
///
/// A forged certificate that the verifier accepts is harmless if its claim is true all the same: then the engine, given
/// the forged model and start, makes the motion that the certificate tells.
#include <string>

namespace campaign {

/// @returns empty if the certificate tells the motion that its model has; else what is told otherwise
[[nodiscard]] std::string told_otherwise(const std::string& certificate);

}  // namespace campaign
