#include "losses.h"

#include <utility>

namespace asperity::studio {

void Losses::add(std::string_view sentence, std::string_view reason) noexcept {
  const std::lock_guard lock(mutex_);
  try {
    std::string text(sentence);
    if (!reason.empty()) text.append(": ").append(reason);
    sentences_.push_back(std::move(text));
  } catch (const std::exception&) {
    has_unnamed_ = true;
  }
}

std::vector<std::string> Losses::take() {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> out = std::exchange(sentences_, {});
  if (std::exchange(has_unnamed_, false))
    out.emplace_back("something else is lost; there was not enough memory to name it");
  return out;
}

}  // namespace asperity::studio
