/// (to be written)
#include "bind.hpp"
namespace slapstick::python {
void bind_certificate(nb::module_&) {}
}
