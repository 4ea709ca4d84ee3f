/// (to be written)
#include "bind.hpp"
namespace slapstick::python {
void bind_section(nb::module_&) {}
}
