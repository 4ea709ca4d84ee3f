#pragma once
/// What the study hands over: claims.json and index.html.
#include "reproduce/study.hpp"

namespace slapstick::paper {

/// claims.json: no times and no paths in it, so that equal results are equal bytes.
[[nodiscard]] std::string claims_json(const Options& options, const std::vector<Claim>& claims);

/// index.html, with the pictures inside. `folder` holds them. @throws StorageError if one cannot be read
[[nodiscard]] std::string index_html(const Options& options, const std::vector<Claim>& claims,
                                     const std::vector<Part>& parts);

}  // namespace slapstick::paper
