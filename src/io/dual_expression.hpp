#pragma once
/// The derivative of an expression, from its text.
#include "io/dual.hpp"
#include "io/expression.hpp"

namespace slapstick {

/// Value and derivative of an expression. The grammar is that of docs/model_file.md; an Expression's text has been
/// found sound.
/// @param names must hold all of the expression's names
[[nodiscard]] Dual differentiated(const Expression& expression, const Duals& names);

}  // namespace slapstick
