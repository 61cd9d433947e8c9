#pragma once

#include <exception>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::studio {

// What could not be stored, in sentences, until the studio's end states it. Thread-safe.
class Losses {
 public:
  void add(std::string_view sentence) noexcept { add(sentence, ""); }
  void add(std::string_view sentence, std::string_view reason) noexcept;

  // Does `work`. What it throws is a loss, with `sentence` before the reason.
  template <class Work>
  void attempt(std::string_view sentence, const Work& work) noexcept {
    try {
      work();
    } catch (const std::exception& fault) {
      add(sentence, fault.what());
    } catch (...) {
      add(sentence, "unknown error");
    }
  }

  std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> sentences_;
  bool has_unnamed_ = false;  // no memory was left for a sentence
};

}  // namespace asperity::studio
