/// (to be written)
#include "bind.hpp"
namespace slapstick::python {
void bind_locus(nb::module_&) {}
}
