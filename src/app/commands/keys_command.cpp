// A folder with an authority and a folder for each key.
#include "app/commands/keys_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/exit_codes.h"
#include "app/commands/numbers.h"
#include "app/output/say.h"
#include "app/run/run.h"
#include "app/viewer/page_users.h"
#include "net/key_ring.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

const char* const kKeysFooter =
    R"(Runs on one computer need no such keys: their members find keys of the run by its name. For members on other
computers, make a key for each, and copy its folder there (and nothing else; authority.key stays here):

  roboss keys add keys controller --role controller
  roboss keys add keys sim-1 --role simulator
  roboss keys list keys
  scp -rp keys/sim-1 node2:
  roboss controller city.sdf --interface eth0 --keys keys/controller       here
  roboss simulator --controller node1 --keys sim-1                         on node2
  roboss keys revoke keys sim-1

A Client's key may order every robot in every way and steer the run (pause, save, rewind, add and remove robots, end
it), unless its rights are limited. They are signed with it, so only a new key changes them:

  roboss keys add keys pilot --role client --robots 'car_*,spider' --orders actuators,velocity
  roboss keys add keys observer --role client --look-only

Users of the viewer's page get a token instead, which is printed once; the file keeps only its digest:

  roboss keys add keys ann --role steer             watch, steer or administer (docs/viewer.md)
  roboss run city.sdf --view 0.0.0.0:8090 --view-users keys/users
  roboss keys revoke keys ann                       also while the run lasts

`roboss cluster up` makes and copies keys by itself. A Controller accepts the keys of its own authority only, and each
only for its role. It reads the list of revoked keys, keys/controller/revoked, again when that changes.

Exit codes: 0 done, 1 a folder, name or role is wrong.)";

struct KeysOptions {
    std::string folder, name, role = "member";
    int days = 365;
    bool json = false;
    std::vector<std::string> robots, orders;
    bool look_only = false, steer = false, no_steer = false;
};

int fail(const Error& error) {
    print(error);
    return kBadInput;
}

/// A key with limited orders does not steer, unless that is asked for.
Result<Rights> rights_of(const KeysOptions& o) {
    if (o.look_only) return make_rights({"*"}, {}, false);
    std::vector<std::string> kinds = o.orders;
    for (std::size_t i = 0; o.orders.empty() && i < kOrderKinds; ++i)
        kinds.emplace_back(order_kind_name(static_cast<OrderKind>(i)));
    const bool limited = o.no_steer || !o.robots.empty() || !o.orders.empty();
    return make_rights(o.robots.empty() ? std::vector<std::string>{"*"} : o.robots, kinds,
                       o.steer || !limited);
}

fs::path users_file(const KeysOptions& o) {
    return fs::path(o.folder) / kUsersFile;
}

int add_user(const KeysOptions& o, const KeyRing& ring, PageRole role) {
    if (ring.has(o.name))
        return fail({"'" + o.name + "' has a key already", "use it, or revoke it first", "key-exists"});
    const Result<std::string> token = add_page_user(users_file(o), o.name, role);
    if (!token) return fail(token.error());
    say("{}\n", token.value());
    say(stderr, "roboss: the token of {}, for the page's address: ?token=...; {} is for --view-users\n",
        o.name, users_file(o).string());
    return kSuccess;
}

int add(const KeysOptions& o) {
    const std::optional<PageRole> page_role = parse_page_role(o.role);
    const Result<Seat> seat = seat_of(o.role);
    if (!seat && !page_role)
        return fail({seat.error().message,
                     seat.error().remedy + "; for a user of the page watch, steer or administer",
                     seat.error().code});
    if (Result<> named = check_holder_name(o.name); !named) return fail(named.error());
    if (o.name == kUsersFile)
        return fail({"'" + o.name + "' is the name of the file of users", "give another name", "bad-name"});
    const Result<Rights> rights = rights_of(o);
    if (!rights) return fail(rights.error());
    if (page_role && !rights.value().everything())
        return fail({"the rights of a user of the page are those of its role",
                     "choose watch, steer or administer, and leave --robots, --orders and the like out",
                     "bad-rights"});
    Result<KeyRing> ring = KeyRing::open(o.folder);
    if (!ring) return fail(ring.error());
    if (page_role) return add_user(o, ring.value(), *page_role);
    const Result<std::vector<PageUser>> users = page_users_of(users_file(o));
    if (!users) return fail(users.error());
    if (names_user(users.value(), o.name))
        return fail({"'" + o.name + "' has a token already", "use it, or revoke it first", "key-exists"});
    if (Result<> added = ring.value().add(o.name, seat.value(), o.days, rights.value()); !added)
        return fail(added.error());
    say("{}/{}: the key of a {}, for its --keys\n", o.folder, o.name, o.role);
    return kSuccess;
}

/// A ring that is there: looking at one makes none.
Result<KeyRing> ring_of(const KeysOptions& o) {
    std::error_code error;
    if (!std::filesystem::exists(o.folder, error))
        return Error{"there is no folder " + o.folder, "`roboss keys add` makes it", "no-keys"};
    return KeyRing::open(o.folder);
}

/// Empty: the key is not for a Client.
std::string rights_column(const Holder& holder) {
    const bool orders = holder.seat == Seat::kClient || holder.seat == Seat::kMember;
    return orders ? rights_text(holder.rights) : "";
}

int list(const KeysOptions& o) {
    Result<KeyRing> ring = ring_of(o);
    if (!ring) return fail(ring.error());
    const Result<std::vector<Holder>> holders = ring.value().holders();
    if (!holders) return fail(holders.error());
    const Result<std::vector<PageUser>> users = page_users_of(users_file(o));
    if (!users) return fail(users.error());
    if (o.json) {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (const Holder& holder : holders.value())
            all.push_back({{"name", holder.name},
                           {"role", seat_name(holder.seat)},
                           {"expires", holder.expires},
                           {"serial", holder.serial},
                           {"rights", rights_column(holder)}});
        for (const PageUser& user : users.value())
            all.push_back({{"name", user.name}, {"role", name_of(user.role)}});
        say("{}\n", all.dump(2));
        return kSuccess;
    }
    say("{:24}  {:10}  {:20}  {}\n", "NAME", "ROLE", "EXPIRES", "RIGHTS");
    for (const Holder& holder : holders.value())
        say("{:24}  {:10}  {:20}  {}\n", holder.name, seat_name(holder.seat), holder.expires,
            rights_column(holder));
    for (const PageUser& user : users.value())
        say("{:24}  {:10}  {:20}\n", user.name, name_of(user.role), "never");
    return kSuccess;
}

/// The key comes first: a file of users that cannot be read shall not keep it good.
int revoke(const KeysOptions& o) {
    Result<KeyRing> ring = ring_of(o);
    if (!ring) return fail(ring.error());
    const Result<> revoked = ring.value().revoke(o.name);
    if (revoked)
        say("the key of {} is revoked; Controllers with their keys elsewhere need the new file `revoked`\n",
            o.name);
    const Result<std::vector<PageUser>> users = page_users_of(users_file(o));
    if (!users) return fail(users.error());
    if (!names_user(users.value(), o.name)) return revoked ? kSuccess : fail(revoked.error());
    if (Result<> removed = remove_page_user(users_file(o), o.name); !removed) return fail(removed.error());
    say("the token of {} is revoked; runs notice it within a second or two\n", o.name);
    return kSuccess;
}

void add_rights_options(CLI::App& sub, KeysOptions& o) {
    constexpr const char* kGroup = "Rights of a Client (default: all)";
    const auto list = [&](const char* name, std::vector<std::string>& words, const char* what) {
        return sub.add_option(name, words, what)->delimiter(',')->allow_extra_args(false)->group(kGroup);
    };
    CLI::Option* robots =
        list("--robots", o.robots, "robots that it may order: names and patterns, 'car_*,spider'");
    CLI::Option* orders =
        list("--orders", o.orders,
             "kinds of orders that it may give: pose, velocity, force, actuators, bonds, radio");
    CLI::Option* steer =
        sub.add_flag("--steer", o.steer,
                     "it may pause, save, rewind, change and end the run, although its orders are limited")
            ->group(kGroup);
    CLI::Option* no_steer = sub.add_flag("--no-steer", o.no_steer, "it may only order")->group(kGroup);
    steer->excludes(no_steer);
    sub.add_flag("--look-only", o.look_only,
                 "it may neither order nor steer, and the world never waits for it")
        ->excludes(robots)
        ->excludes(orders)
        ->excludes(steer)
        ->group(kGroup);
}

}  // namespace

void add_keys_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand(
        "keys",
        "make, list and revoke the keys of members on other computers, and the tokens of users of the page");
    command->footer(kKeysFooter);
    command->require_subcommand(1);
    auto o = std::make_shared<KeysOptions>();
    const auto folder = [&](CLI::App* sub) {
        sub->add_option("folder", o->folder, "folder of the authority and its keys")->required();
    };
    CLI::App* sub = command->add_subcommand("add", "make a key, and the authority if the folder is new");
    folder(sub);
    sub->add_option("name", o->name, "of its holder")->required();
    sub->add_option(
           "--role", o->role,
           "controller, simulator, client, or member (Simulator or Client); for a user of the viewer's "
           "page: watch, steer or administer")
        ->capture_default_str();
    sub->add_option("--days", o->days, "until it expires (tokens of users do not)")
        ->check(whole_number(1, 36'500))
        ->capture_default_str();
    add_rights_options(*sub, *o);
    sub->callback([o, &exit_code] { exit_code = add(*o); });
    sub = command->add_subcommand("list", "print the names, roles, ends and rights of all keys");
    folder(sub);
    sub->add_flag("--json", o->json, "print a JSON array");
    sub->callback([o, &exit_code] { exit_code = list(*o); });
    sub = command->add_subcommand("revoke", "end a key before it expires");
    folder(sub);
    sub->add_option("name", o->name, "of its holder")->required();
    sub->callback([o, &exit_code] { exit_code = revoke(*o); });
}

}  // namespace roboss
