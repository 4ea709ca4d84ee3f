/// (to be written)
#include "bind.hpp"
namespace slapstick::python {
void bind_orbit(nb::module_&) {}
}
