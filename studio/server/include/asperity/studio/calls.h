#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/studio/hub.h"
#include "asperity/studio/message.h"

namespace asperity::studio {

// An Error with what to do about it.
class Advice : public Error {
 public:
  Advice(const std::string& message, std::string hint) : Error(message), hint_(std::move(hint)) {}
  const std::string& hint() const { return hint_; }

 private:
  std::string hint_;
};

// One call of one browser, to be answered exactly once: now, or later from the studio's thread. Copyable.
// Answers after the browser has gone are lost without harm.
class Request {
 public:
  Request(Hub& hub, ClientId client, Call call) : hub_(&hub), client_(client), call_(std::move(call)) {}

  ClientId client() const { return client_; }
  const std::string& name() const { return call_.name; }
  const Json& args() const { return call_.args; }

  // Arguments by name. Throw Error naming call, argument and value if one is missing or of another type, is not finite
  // or not UTF-8.
  double number(std::string_view name) const;
  std::int64_t integer(std::string_view name) const;
  bool flag(std::string_view name) const;
  std::string text(std::string_view name) const;
  std::vector<double> numbers(std::string_view name, std::size_t count) const;
  bool has(std::string_view name) const { return call_.args.contains(name); }

  void answer(const Json& result) const { hub_->answer(client_, call_.id, result); }
  void answer(BlockWriter block) const { hub_->answer_block(client_, call_.id, std::move(block)); }
  void done() const { answer(Json::object()); }
  void refuse(const std::exception& error) const;

 private:
  Hub* hub_;
  ClientId client_;
  Call call_;
};

// The calls that the studio knows, by name.
class Calls {
 public:
  using Handler = std::function<void(const Request&)>;

  // Throws Error for a name that is taken.
  void add(std::string name, Handler handler);
  // Calls its handler; what that throws is answered as a refusal, as is an unknown name. Never throws.
  void dispatch(const Request& request) const noexcept;

 private:
  std::map<std::string, Handler, std::less<>> handlers_;
};

}  // namespace asperity::studio
