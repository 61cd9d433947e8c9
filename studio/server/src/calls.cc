#include "asperity/studio/calls.h"

#include <cmath>

#include "asperity/base/text.h"

namespace asperity::studio {

namespace {

std::string words(const Json& value) { return printable(value.dump_repaired(), 60); }

[[noreturn]] void refuse_argument(const std::string& call, std::string_view name, const Json* value, const char* what) {
  const std::string given = value ? words(*value) + " is not " + what : std::string("is missing; it must be ") + what;
  throw Error(call + ": " + std::string(name) + ": " + given);
}

const Json* find_argument(const Json& args, std::string_view name) { return args.find(name); }

}  // namespace

double Request::number(std::string_view name) const {
  const Json* value = find_argument(call_.args, name);
  if (!value || !value->is_number() || !std::isfinite(value->get<double>())) {
    refuse_argument(call_.name, name, value, "a number");
  }
  return value->get<double>();
}

std::int64_t Request::integer(std::string_view name) const {
  const double value = number(name);
  constexpr double kExact = 9007199254740992.0;
  if (value != std::floor(value) || std::abs(value) > kExact) {
    refuse_argument(call_.name, name, find_argument(call_.args, name), "a whole number");
  }
  return static_cast<std::int64_t>(value);
}

bool Request::flag(std::string_view name) const {
  const Json* value = find_argument(call_.args, name);
  if (!value || !value->is_boolean()) refuse_argument(call_.name, name, value, "true or false");
  return value->get<bool>();
}

std::string Request::text(std::string_view name) const {
  const Json* value = find_argument(call_.args, name);
  if (!value || !value->is_string() || !is_utf8(value->text())) {
    refuse_argument(call_.name, name, value, "a text");
  }
  return value->get<std::string>();
}

std::vector<double> Request::numbers(std::string_view name, std::size_t count) const {
  const Json* value = find_argument(call_.args, name);
  const std::string what = "a list of " + std::to_string(count) + " numbers";
  if (!value || !value->is_array() || value->size() != count) {
    refuse_argument(call_.name, name, value, what.c_str());
  }
  std::vector<double> out;
  for (const Json& number : *value) {
    if (!number.is_number() || !std::isfinite(number.get<double>())) {
      refuse_argument(call_.name, name, value, what.c_str());
    }
    out.push_back(number.get<double>());
  }
  return out;
}

void Request::refuse(const std::exception& error) const {
  const auto* advice = dynamic_cast<const Advice*>(&error);
  hub_->refuse(client_, call_.id, error.what(), advice ? advice->hint() : std::string());
}

void Calls::add(std::string name, Handler handler) {
  const auto [at, fresh] = handlers_.try_emplace(std::move(name), std::move(handler));
  if (!fresh) throw Error("the call '" + at->first + "' is given twice");
}

void Calls::dispatch(const Request& request) const noexcept {
  try {
    try {
      const auto found = handlers_.find(request.name());
      if (found == handlers_.end()) throw Error("unknown call '" + request.name() + "'");
      found->second(request);
    } catch (const std::bad_alloc&) {
      request.refuse(Advice("not enough memory", "Close other programs, or open something smaller."));
    } catch (const std::exception& error) {
      request.refuse(error);
    }
  } catch (...) {
    // Not even the refusal could be sent: the browser waits, and the studio continues.
  }
}

}  // namespace asperity::studio
