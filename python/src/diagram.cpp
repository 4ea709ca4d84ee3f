/// (to be written)
#include "bind.hpp"
namespace slapstick::python {
void bind_diagram(nb::module_&) {}
}
