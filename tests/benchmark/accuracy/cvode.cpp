// SUNDIALS 6: CVODE, Adams-Moulton of variable order, with root finding for the collisions.
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <array>

#include "accuracy/event_loop.hpp"
#include "accuracy/instants.hpp"
#include "accuracy/methods.hpp"

namespace piblocks::benchmark {
namespace {

struct DeleteContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct DeleteSolver {
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};
struct DeleteMemory {
  void operator()(void* memory) const { CVodeFree(&memory); }
};
struct DeleteVector {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
using ContextPtr = std::unique_ptr<std::remove_pointer_t<SUNContext>, DeleteContext>;
using VectorPtr = std::unique_ptr<std::remove_pointer_t<N_Vector>, DeleteVector>;
using SolverPtr = std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, DeleteSolver>;
using MemoryPtr = std::unique_ptr<void, DeleteMemory>;

void check(int code, const char* operation) {
  if (code >= 0) return;
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(code), &std::free);
  throw NotRun(fmt::format("failed: {}: {}", operation, name.get()));
}

ContextPtr make_context() {
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
  return ContextPtr(context);
}

/// The four numbers that are integrated, in this order.
enum Component : std::size_t { kBlue, kRed, kBlueVelocity, kRedVelocity, kComponents };

/// When gaps close: the parts of a system that the root functions need.
struct Contacts {
  double wall;    // blue's position at the wall
  double blocks;  // distance of the centres
};

int derivative(realtype, N_Vector state, N_Vector rate, void*) {
  const double* y = N_VGetArrayPointer(state);
  double* dy = N_VGetArrayPointer(rate);
  dy[kBlue] = y[kBlueVelocity];
  dy[kRed] = y[kRedVelocity];
  dy[kBlueVelocity] = 0;
  dy[kRedVelocity] = 0;
  return 0;
}

int gaps(realtype, N_Vector state, realtype* gap, void* user_data) {
  const double* y = N_VGetArrayPointer(state);
  const auto& contacts = *static_cast<const Contacts*>(user_data);
  gap[0] = y[kBlue] - contacts.wall;
  gap[1] = y[kRed] - y[kBlue] - contacts.blocks;
  return 0;
}

/// One run of the solver, from collision to collision or to times asked for.
class Integration {
 public:
  Integration(const TwoBlocks& system, double tolerance)
      : contacts_{to_double(system.wall_face + system.blue.width / 2),
                  to_double((system.blue.width + system.red.width) / 2)},
        blue_share_(to_double(2 * system.red.mass / (system.blue.mass + system.red.mass))),
        red_share_(to_double(2 * system.blue.mass / (system.blue.mass + system.red.mass))),
        state_(N_VNew_Serial(kComponents, context_.get())),
        solver_(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get())),
        memory_(CVodeCreate(CV_ADAMS, context_.get())) {
    const Flight<double> start = start_of<double>(system);
    y()[kBlue] = start.blue;
    y()[kRed] = start.red;
    y()[kBlueVelocity] = start.blue_velocity;
    y()[kRedVelocity] = start.red_velocity;
    check(CVodeInit(memory_.get(), derivative, 0, state_.get()), "CVodeInit");
    check(CVodeSStolerances(memory_.get(), tolerance, tolerance), "CVodeSStolerances");
    check(CVodeSetNonlinearSolver(memory_.get(), solver_.get()), "CVodeSetNonlinearSolver");
    check(CVodeSetUserData(memory_.get(), &contacts_), "CVodeSetUserData");
    check(CVodeRootInit(memory_.get(), 2, gaps), "CVodeRootInit");
    // Only gaps that close are of interest, or every collision would be found twice.
    std::array<int, 2> closing = {-1, -1};
    check(CVodeSetRootDirection(memory_.get(), closing.data()), "CVodeSetRootDirection");
    check(CVodeSetErrFile(memory_.get(), nullptr), "CVodeSetErrFile");
  }
  Integration(const Integration&) = delete;
  Integration& operator=(const Integration&) = delete;

  /// Integrates to the next collision, performs it and says true; or to `end`.
  bool advance_to(double end) {
    const int code = CVode(memory_.get(), end, state_.get(), &time_, CV_NORMAL);
    check(code, "CVode");
    if (code != CV_ROOT_RETURN) return false;
    std::array<int, 2> closed{};
    check(CVodeGetRootInfo(memory_.get(), closed.data()), "CVodeGetRootInfo");
    if (closed[1] != 0) meet_red();
    if (closed[0] != 0) y()[kBlueVelocity] = -y()[kBlueVelocity];
    check(CVodeReInit(memory_.get(), time_, state_.get()), "CVodeReInit");
    return true;
  }

  double time() const { return time_; }
  double blue() const { return N_VGetArrayPointer(state_.get())[kBlue]; }
  double red() const { return N_VGetArrayPointer(state_.get())[kRed]; }

 private:
  double* y() { return N_VGetArrayPointer(state_.get()); }

  void meet_red() {
    const double closing_speed = y()[kBlueVelocity] - y()[kRedVelocity];
    y()[kBlueVelocity] -= blue_share_ * closing_speed;
    y()[kRedVelocity] += red_share_ * closing_speed;
  }

  Contacts contacts_;
  double blue_share_;
  double red_share_;
  ContextPtr context_ = make_context();
  VectorPtr state_;
  SolverPtr solver_;
  MemoryPtr memory_;
  double time_ = 0;
};

class Cvode final : public Method {
 public:
  explicit Cvode(double tolerance)
      : Method({"CVODE Adams", kScalarName<double>, fmt::format("tol={:.0e}", tolerance)}),
        tolerance_(tolerance) {}

  WholeLog whole_log(const TwoBlocks& system, std::span<const std::int64_t> wanted,
                     const Deadline& deadline) const override {
    Integration run(system, tolerance_);
    LogWriter<double> writer(wanted, deadline);
    while (run.advance_to(kLastInstant_s)) {
      writer.push(run.time(), run.blue(), run.red());
      deadline.check();
    }
    return writer.finish();
  }

  /// Without events the solver would step over them unseen, so they are found here as well.
  Numbers blue_at(const TwoBlocks& system, const Instants& instants,
                  const Deadline& deadline) const override {
    Integration run(system, tolerance_);
    std::vector<double> blue;
    blue.reserve(instants.seconds.size());
    for (const double time : instants.seconds) {
      while (run.advance_to(time)) deadline.check();
      blue.push_back(run.blue());
    }
    return blue;
  }

  Integer count(const TwoBlocks& system, const Deadline& deadline) const override {
    Integration run(system, tolerance_);
    std::int64_t events = 0;
    for (; run.advance_to(kLastInstant_s); ++events) deadline.check();
    return events;
  }

 private:
  double tolerance_;
};

}  // namespace

std::vector<MethodPtr> cvode_methods() {
  std::vector<MethodPtr> methods;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    methods.push_back(std::make_unique<Cvode>(tolerance));
  }
  return methods;
}

}  // namespace piblocks::benchmark
