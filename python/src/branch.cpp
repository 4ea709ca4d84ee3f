/// (to be written)
#include "bind.hpp"
namespace slapstick::python {
void bind_branch(nb::module_&) {}
}
