#pragma once
// Adaptive steps on the group (adaptive.hpp) by the embedded 5(4) pair of Dormand and Prince. Order 5.
//
//   e = h sum (b_i - b^_i) (K_i, A_i)

#include <liecheck/scene/integrators/adaptive.hpp>
#include <liecheck/scene/integrators/munthe_kaas.hpp>

namespace liecheck::scene {

struct DormandPrinceTableau {
  static constexpr int stages = 7;
  static constexpr Rational a[7][7] = {{},
                                       {{1, 5}},
                                       {{3, 40}, {9, 40}},
                                       {{44, 45}, {-56, 15}, {32, 9}},
                                       {{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}},
                                       {{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}},
                                       {{35, 384}, {}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}}};
  static constexpr Rational b[7] = {{35, 384}, {}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}, {}},
                            error[7] = {{71, 57600},      {},        {-71, 16695}, {71, 1920},
                                        {-17253, 339200}, {22, 525}, {-1, 40}},
                            c[7] = {{}, {1, 5}, {3, 10}, {4, 5}, {8, 9}, {1}, {1}};
};

template <System Sys>
class Dopri5 final : public Adaptive<Sys> {
 public:
  using S = typename Sys::Scalar;
  static constexpr MethodInfo info{
      .name = "dopri5",
      .order = 5,
      .equation = "embedded 5(4) for (delta, v), error estimated in the tangent space",
      .source = "Dormand & Prince 1980; Munthe-Kaas 1999",
      .increments = true,
      .adaptive = true,
      .estimate_order = 5};
  using Adaptive<Sys>::Adaptive;
  const MethodInfo& what() const override { return info; }
  void begin(Sys& system, const State<Sys>& state) override {
    Adaptive<Sys>::begin(system, state);
    stages_.begin(state);
  }

 private:
  S attempt(Sys& system, const State<Sys>& from, const S& h) override {
    stages_.compute(system, from, h);
    stages_.template sum<DormandPrinceTableau::error>(h, this->e_delta_, this->e_v_);
    return this->errorOf(from);
  }
  void accepted(const S& h) override {
    stages_.template sum<DormandPrinceTableau::b>(h, this->delta_, this->dv_);
  }

  MuntheKaasStages<Sys, DormandPrinceTableau> stages_;
};

}  // namespace liecheck::scene
