#include "runtime/node/app_actors.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "runtime/core/check.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/net/net_config.hpp"

namespace luxodus {

namespace {

/// An AppMessage and its tables in Cap'n Proto take 80 bytes.
constexpr size_t own_head_bytes = 128;
/// Longest content that fits into one chunk of the control lane.
constexpr size_t max_short_bytes = defaults::small_chunk_bytes - own_head_bytes;

/// The first wait for an answer: a stall of the other node's thread, or a link that comes up. Each
/// copy of the request doubles it.
constexpr Nanoseconds first_wait = milliseconds(100);
constexpr Nanoseconds longest_wait = seconds(2);

/// Lowest hash of a name: numbers below are of the runtime's own parts.
constexpr uint64_t first_name = 16;

/// Mail that an actor handles before others get their turn.
constexpr size_t mail_at_once = 32;

}  // namespace

uint64_t name_hash(std::string_view name) {
  return std::max(first_name, object_id_of(std::as_bytes(std::span(name))).value);
}

SharedBytes shared_copy(std::span<const std::byte> bytes) {
  const auto copy = std::make_shared_for_overwrite<std::byte[]>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), copy.get());
  return {{copy.get(), bytes.size()}, copy};
}

// ---- one actor

AppActor::AppActor(Scheduler& scheduler, std::string name, size_t mailbox, Handler handler,
                   std::function<void()> reset)
    : scheduler_(scheduler),
      name_(std::move(name)),
      mail_(mailbox),
      handler_(std::move(handler)),
      reset_(std::move(reset)) {}

void AppActor::start() {
  const auto fiber = scheduler_.fibers().start(name_.c_str(), [this] { handle_mail(); });
  LUX_CHECK(fiber.has_value(), "no fiber for an actor; the limits must count one for each");
}

bool AppActor::offer(Mail mail) {
  if (!mail_.push(std::move(mail))) {
    ++rejected_;
    return false;
  }
  scheduler_.fibers().wake_one(idle_);
  return true;
}

void AppActor::reset() {
  if (reset_) reset_();
}

void AppActor::forget_mailbox() {
  while (!mail_.empty()) (void)mail_.pop();
}

void AppActor::handle_mail() {
  Fibers& fibers = scheduler_.fibers();
  for (size_t handled = 0; !fibers.cancelled();) {
    if (mail_.empty() || failed()) {
      if (fibers.wait(idle_, failed() ? "failed" : "mailbox empty") == Wake::cancelled) return;
      continue;
    }
    Mail mail = mail_.pop();
    guarded([&] { handler_(mail); });
    if (++handled % mail_at_once == 0 && fibers.yield() == Wake::cancelled) return;
  }
}

// ---- all of them

AppActor& AppActors::add(std::unique_ptr<AppActor> actor) {
  AppActor& added = *actors_.emplace_back(std::move(actor));
  LUX_CHECK(by_name_.emplace(name_hash(added.name()), &added).second, "two actors of one name");
  return added;
}

AppActor* AppActors::find(uint64_t name) {
  const auto at = by_name_.find(name);
  return at == by_name_.end() ? nullptr : at->second;
}

SendOutcome AppActors::send(const AppHead& head, NodeId to, const MessageId& id,
                            SharedBytes content) {
  const Address from{system_.self(), ActorName::application};
  const Address receiver{to, ActorName::application};
  if (content.bytes.size() <= max_short_bytes)
    return system_.send(from, receiver, id, AppMessage{head}, std::move(content));
  return system_.send(from, receiver, id, AppBulk{head}, std::move(content));
}

Result<Mail> AppActors::ask(const ActorRef& to, uint64_t schema, SharedBytes content,
                            Nanoseconds patience) {
  const MessageId id = system_.next_id();
  Question question;
  questions_[id.sequence] = &question;
  const Nanoseconds end = scheduler_.clock().now() + patience;
  Nanoseconds wait = first_wait;
  Wake how = Wake::woken;
  for (bool again = false; !question.answer && how != Wake::cancelled; again = true) {
    const Nanoseconds now = scheduler_.clock().now();
    if (now >= end) break;
    const SendOutcome sent = send({0, to.name, schema, false}, to.node, id, content);
    const bool left = sent == SendOutcome::taken;
    if (left && again) ++counters_.retries;
    how = scheduler_.wait_until(question.asker,
                                std::min(end, now + (left ? wait : milliseconds(20))), "answer");
    if (left) wait = std::min(2 * wait, longest_wait);
  }
  questions_.erase(id.sequence);
  if (question.answer) return std::move(*question.answer);
  if (how == Wake::cancelled) return node_leaves();
  return problem(fmt::format("no answer from node {} within {} s: is it up, and has it an actor of "
                             "this name?",
                             to.node.value, seconds_in(patience)),
                 ProblemKind::lost_peer);
}

std::optional<Offered> AppActors::accept(IncomingMessage incoming) {
  const AppHead* head = nullptr;
  if (const auto* shorter = std::get_if<AppMessage>(&incoming.message)) head = &shorter->head;
  if (const auto* longer = std::get_if<AppBulk>(&incoming.message)) head = &longer->head;
  if (head == nullptr) return std::nullopt;
  Mail mail{
      {incoming.from.node, head->from}, incoming.id, head->schema, std::move(incoming.payload)};
  if (const auto line = lines_.find(head->to); line != lines_.end()) {
    line->second(mail);
    return Offered::taken;
  }
  if (head->answer) {
    const auto at = questions_.find(mail.id.sequence);
    if (mail.id.node != system_.self() || at == questions_.end()) {
      ++counters_.late;
      return Offered::taken;
    }
    if (!at->second->answer) at->second->answer = std::move(mail);
    scheduler_.fibers().wake_one(at->second->asker);
    return Offered::taken;
  }
  AppActor* actor = find(head->to);
  if (actor == nullptr) {
    ++counters_.no_actor;
    return Offered::taken;
  }
  if (actor->offer(std::move(mail))) return Offered::taken;
  ++counters_.rejected;
  return Offered::rejected;
}

size_t AppActors::waiting() const {
  size_t count = 0;
  for (const auto& actor : actors_) count += actor->waiting();
  return count;
}

}  // namespace luxodus
