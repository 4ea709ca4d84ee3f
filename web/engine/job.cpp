/// Runs a slice of a job, and keeps what went wrong.
#include "job.hpp"

#include "slapstick/base/error.hpp"

namespace slapstick::web {

bool Job::advance(double milliseconds) {
  if (done_) return true;
  try {
    done_ = work(Deadline(milliseconds));
  } catch (const NumericalError& error) {
    failure_ = error.what();
    done_ = true;
  } catch (const InputError& error) {
    failure_ = error.what();
    done_ = true;
  }
  return done_;
}

}  // namespace slapstick::web
