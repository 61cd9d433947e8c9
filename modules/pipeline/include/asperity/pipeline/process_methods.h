#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

#include "asperity/pipeline/ekf_method.h"
#include "asperity/pipeline/fused_method.h"
#include "asperity/pipeline/particle_method.h"
#include "asperity/pipeline/process_method.h"
#include "asperity/pipeline/raw_method.h"
#include "asperity/pipeline/thesis_method.h"
#include "asperity/pipeline/thesis_tuned_method.h"

namespace asperity {

// A method by its place in the table.
enum class Method : std::size_t {};

// The settings of all methods, by inheritance, and the methods themselves.
template <class... Methods>
struct MethodTable : Methods... {
  static constexpr std::array<std::string_view, sizeof...(Methods)> kNames{Methods::kMethodName...};
  static constexpr std::array<std::string_view, sizeof...(Methods)> kTitles{Methods::kMethodTitle...};

  template <class Wanted>
  static constexpr Method method() {
    static_assert((std::is_same_v<Wanted, Methods> || ...), "not in the table");
    constexpr std::array<bool, sizeof...(Methods)> is_wanted{std::is_same_v<Wanted, Methods>...};
    std::size_t at = 0;
    while (!is_wanted[at]) ++at;
    return Method{at};
  }

  template <class V>
  void visit_methods(V& v) {
    (this->Methods::visit_method(v), ...);
  }

  // The methods' names and what they are: "fused (ours), thesis (the baseline), …".
  static std::string describe() {
    std::string out;
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      out.append(i == 0 ? "" : i + 1 < kNames.size() ? ", " : " or ");
      out.append(kNames[i]).append(" (").append(kTitles[i]).append(")");
    }
    return out;
  }

  static const ProcessMethod& get(Method method) {
    static const std::array<ProcessMethod, sizeof...(Methods)> all{Methods::make_method()...};
    return all.at(static_cast<std::size_t>(method));
  }
};

// Every method of process_recording.h, the default first.
using ProcessMethods = MethodTable<  //
    FusedMethod,                     //
    ThesisMethod,                    //
    ThesisTunedMethod,               //
    RawMethod,                       //
    EkfMethod,                       //
    ParticleMethod>;

inline constexpr auto kMethodNames = ProcessMethods::kNames;

}  // namespace asperity
