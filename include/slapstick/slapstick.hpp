#pragma once
/// Every public header of slapstick. docs/reference/library.md shows five tasks; each header says what it holds,
/// what it costs and what it throws.
///
///     model         what a machine is, as plain data; model files (io)
///     mode          contact states
///     flow          compiled models, their motions, tangents, natural frequencies
///     section       motions as sequences of points
///     attractor     what a motion settles on
///     sweep         bifurcation diagrams, charts, basins of attraction
///     orbit         periodic orbits, stable or not
///     continuation  branches of orbits and loci of special points
///     quantity      forces, accelerations, energies: statistics and spectra
///     certify       runs as certificates
///
/// Only these headers are installed. What they do not declare is private and may change in any release.
#include "slapstick/attractor/classify.hpp"
#include "slapstick/attractor/lyapunov.hpp"
#include "slapstick/base/clock.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/batch/run.hpp"
#include "slapstick/certify/certificate.hpp"
#include "slapstick/chart/chart.hpp"
#include "slapstick/chart/curves.hpp"
#include "slapstick/chart/start_plane.hpp"
#include "slapstick/continuation/branch.hpp"
#include "slapstick/continuation/sentences.hpp"
#include "slapstick/flow/energy_sources.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/flow/natural_modes.hpp"
#include "slapstick/flow/run_up.hpp"
#include "slapstick/flow/stage.hpp"
#include "slapstick/flow/struck_together.hpp"
#include "slapstick/flow/system.hpp"
#include "slapstick/flow/tangent.hpp"
#include "slapstick/io/model_file.hpp"
#include "slapstick/io/observer.hpp"
#include "slapstick/mode/contact_states.hpp"
#include "slapstick/model/family.hpp"
#include "slapstick/model/model.hpp"
#include "slapstick/model/quantity.hpp"
#include "slapstick/orbit/find.hpp"
#include "slapstick/orbit/itinerary.hpp"
#include "slapstick/orbit/periodic_orbit.hpp"
#include "slapstick/orbit/search.hpp"
#include "slapstick/orbit/special_point.hpp"
#include "slapstick/quantity/cycle_energy.hpp"
#include "slapstick/quantity/measure.hpp"
#include "slapstick/quantity/observables.hpp"
#include "slapstick/quantity/order_map.hpp"
#include "slapstick/quantity/quantity.hpp"
#include "slapstick/quantity/reader.hpp"
#include "slapstick/quantity/span.hpp"
#include "slapstick/quantity/spectrum.hpp"
#include "slapstick/section/event_section.hpp"
#include "slapstick/section/impact_section.hpp"
#include "slapstick/section/sampled_motion.hpp"
#include "slapstick/section/stop_choice.hpp"
#include "slapstick/section/stroboscopic_section.hpp"
#include "slapstick/store/store.hpp"
#include "slapstick/sweep/basins.hpp"
#include "slapstick/sweep/batch.hpp"
#include "slapstick/sweep/diagram.hpp"
#include "slapstick/sweep/map.hpp"
#include "slapstick/sweep/parallel.hpp"
