/// The handle of a compiled model.
#include "slapstick/flow/system.hpp"

#include <utility>

#include "flow/compiled_system.hpp"

namespace slapstick {

System::System(Model model, SystemOptions options)
    : compiled_(std::make_shared<const flow::CompiledSystem>(std::move(model), options)) {}

const Model& System::model() const { return compiled_->model(); }
double System::period() const { return compiled_->period(); }
double System::windows_per_period() const { return compiled_->windows_per_period(); }
ModeId System::mode_count() const { return compiled_->mode_count(); }
ModeId System::mode_id(const mode::ContactStates& states) const { return compiled_->mode_id(states); }
mode::ContactStates System::states(ModeId id) const { return compiled_->states(id); }
std::string System::mode_name(ModeId id) const { return compiled_->mode_name(id); }
std::string System::contact_name(int contact) const { return compiled_->contact_name(contact); }

}  // namespace slapstick
