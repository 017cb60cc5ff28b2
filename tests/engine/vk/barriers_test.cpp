#include "vk/barriers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <tuple>

namespace voxilux {
namespace {

ProgramInfo with_blocks(std::vector<BufferBlock> blocks) {
    ProgramInfo info;
    info.blocks = std::move(blocks);
    return info;
}

ProgramInfo with_addresses(ProgramInfo info, std::vector<AddressMember> addresses) {
    info.addresses = std::move(addresses);
    return info;
}

// "copy" reads In and writes Out; "update" does both to Data; "fill" writes Out. "gather" reads what `from`
// points to and writes Out, "scatter" reads In and writes what `to` points to, "stir" does both to `data`.
const ProgramInfo& program(std::string_view shader) {
    static const std::map<std::string, ProgramInfo, std::less<>> programs = {
        {"copy", with_blocks({{.name = "In", .binding = 0, .writable = false},
                              {.name = "Out", .binding = 1, .readable = false}})},
        {"update", with_blocks({{.name = "Data", .binding = 0}})},
        {"fill", with_blocks({{.name = "Out", .binding = 0, .readable = false}})},
        {"gather", with_addresses(with_blocks({{.name = "Out", .binding = 0, .readable = false}}),
                                  {{.name = "from", .writable = false}})},
        {"scatter", with_addresses(with_blocks({{.name = "In", .binding = 0, .writable = false}}),
                                   {{.name = "to", .readable = false}})},
        {"stir", with_addresses({}, {{.name = "data"}})},
    };
    return programs.find(shader)->second;
}

const BarrierContext kUnmapped{.program = program};
const BarrierContext kMapped{.program = program, .is_mapped = [](std::string_view) { return true; }};

Dispatch copy(const std::string& from, const std::string& to) {
    return {.label = "t.copy", .shader = "copy", .bindings = {{"In", from}, {"Out", to}}};
}
Dispatch update(const std::string& buffer) {
    return {.label = "t.update", .shader = "update", .bindings = {{"Data", buffer}}};
}
Dispatch fill(const std::string& buffer) {
    return {.label = "t.fill", .shader = "fill", .bindings = {{"Out", buffer}}};
}

Dispatch gather(const std::string& from, const std::string& to) {
    return {
        .label = "t.gather", .shader = "gather", .bindings = {{"Out", to}}, .addresses = {{"from", from}}};
}
Dispatch scatter(const std::string& from, const std::string& to) {
    return {.label = "t.scatter", .shader = "scatter", .bindings = {{"In", from}}, .addresses = {{"to", to}}};
}
Dispatch stir(const std::string& buffer) {
    return {.label = "t.stir", .shader = "stir", .addresses = {{"data", buffer}}};
}

Recording with_buffers(std::initializer_list<const char*> names, bool persistent = false) {
    Recording recording;
    for (const char* name : names)
        recording.declare({.name = name, .size_bytes = 64, .persistent = persistent});
    return recording;
}

Hazard hazard(std::size_t command, const std::string& buffer, HazardKind kind, Stage before, Stage after) {
    return {command, buffer, kind, before, after};
}

using enum HazardKind;

TEST(Barriers, independent_dispatches_need_none) {
    Recording recording = with_buffers({"a", "b", "c", "d"});
    recording.dispatch(copy("a", "b"));
    recording.dispatch(copy("a", "c"));
    recording.dispatch(fill("d"));
    EXPECT_TRUE(derive_barriers(recording, kUnmapped).empty());
}

TEST(Barriers, read_after_write_waits) {
    Recording recording = with_buffers({"a", "b", "c"});
    recording.dispatch(copy("a", "b"));
    recording.dispatch(copy("b", "c"));
    EXPECT_EQ(derive_barriers(recording, kUnmapped),
              std::vector{hazard(1, "b", read_after_write, Stage::compute, Stage::compute)});
}

TEST(Barriers, write_after_read_waits) {
    Recording recording = with_buffers({"a", "b", "c"});
    recording.dispatch(copy("a", "b"));
    recording.dispatch(copy("c", "a"));
    EXPECT_EQ(derive_barriers(recording, kUnmapped),
              std::vector{hazard(1, "a", write_after_read, Stage::compute, Stage::compute)});
}

// A case that synchronization validation does not notice.
TEST(Barriers, dispatch_after_dispatch_to_one_buffer_waits) {
    Recording recording = with_buffers({"a"});
    recording.dispatch(fill("a"));
    recording.dispatch(fill("a"));
    EXPECT_EQ(derive_barriers(recording, kUnmapped),
              std::vector{hazard(1, "a", write_after_write, Stage::compute, Stage::compute)});
}

TEST(Barriers, update_after_update_waits) {
    Recording recording = with_buffers({"a"});
    recording.dispatch(update("a"));
    recording.dispatch(update("a"));
    EXPECT_EQ(derive_barriers(recording, kUnmapped),
              std::vector{hazard(1, "a", read_after_write, Stage::compute, Stage::compute)});
}

TEST(Barriers, transfers_count_when_staged) {
    const std::array<std::byte, 4> word{};
    Recording recording = with_buffers({"a", "b"});
    recording.upload("a", word);
    recording.clear("b");
    recording.dispatch(copy("a", "b"));
    recording.readback("b");
    recording.clear("b");
    EXPECT_EQ(derive_barriers(recording, kUnmapped),
              (std::vector{hazard(2, "a", read_after_write, Stage::transfer, Stage::compute),
                           hazard(2, "b", write_after_write, Stage::transfer, Stage::compute),
                           hazard(3, "b", read_after_write, Stage::compute, Stage::transfer),
                           hazard(4, "b", write_after_read, Stage::transfer, Stage::transfer)}));
}

TEST(Barriers, mapped_buffers_are_written_before_and_read_after_all) {
    const std::array<std::byte, 4> word{};
    Recording recording = with_buffers({"a", "b"});
    recording.upload("a", word);
    recording.dispatch(copy("a", "b"));
    recording.readback("b");
    EXPECT_EQ(derive_barriers(recording, kMapped),
              std::vector{hazard(2, "b", read_after_write, Stage::compute, Stage::host)});
    EXPECT_TRUE(is_direct_transfer(recording, 0, kMapped));
    EXPECT_TRUE(is_direct_transfer(recording, 2, kMapped));
    EXPECT_FALSE(is_direct_transfer(recording, 0, kUnmapped));
}

TEST(Barriers, transfer_amid_other_uses_is_not_direct) {
    const std::array<std::byte, 4> word{};
    Recording recording = with_buffers({"a", "b"});
    recording.dispatch(copy("a", "b"));
    recording.upload("a", word);
    recording.readback("b");
    recording.dispatch(copy("a", "b"));
    EXPECT_FALSE(is_direct_transfer(recording, 1, kMapped));
    EXPECT_FALSE(is_direct_transfer(recording, 2, kMapped));
}

TEST(Barriers, indirect_arguments_are_waited_for) {
    Recording recording = with_buffers({"args", "a"});
    recording.dispatch(fill("args"));
    recording.dispatch_indirect(fill("a"), "args");
    recording.dispatch(fill("args"));
    EXPECT_EQ(derive_barriers(recording, kUnmapped),
              (std::vector{hazard(1, "args", read_after_write, Stage::compute, Stage::indirect),
                           hazard(2, "args", write_after_read, Stage::indirect, Stage::compute)}));
}

TEST(Barriers, persistent_buffers_start_as_written) {
    Recording recording = with_buffers({"a"}, true);
    recording.dispatch(update("a"));
    EXPECT_EQ(derive_barriers(recording, kUnmapped),
              std::vector{hazard(0, "a", read_after_write, Stage::earlier_run, Stage::compute)});
}

TEST(Barriers, one_barrier_serves_all_that_wait_for_the_same) {
    Recording recording = with_buffers({"a", "b", "c", "d", "e"});
    recording.dispatch(copy("a", "b"));
    recording.dispatch(copy("a", "c"));
    recording.dispatch(copy("b", "d"));  // orders both writes
    recording.dispatch(copy("c", "e"));
    EXPECT_EQ(derive_barriers(recording, kUnmapped),
              std::vector{hazard(2, "b", read_after_write, Stage::compute, Stage::compute)});
}

TEST(Barriers, one_buffer_in_two_blocks_of_a_dispatch_is_no_hazard_of_its_own) {
    Recording recording = with_buffers({"a"});
    recording.dispatch(copy("a", "a"));
    EXPECT_TRUE(derive_barriers(recording, kUnmapped).empty());
}

TEST(Barriers, write_by_address_is_waited_for_by_reads_of_either_kind) {
    for (const Dispatch& reader : {copy("a", "c"), gather("a", "c")}) {
        Recording recording = with_buffers({"a", "b", "c"});
        recording.dispatch(scatter("b", "a"));
        recording.dispatch(reader);
        EXPECT_EQ(derive_barriers(recording, kUnmapped),
                  std::vector{hazard(1, "a", read_after_write, Stage::compute, Stage::compute)})
            << reader.label;
    }
}

TEST(Barriers, read_by_address_waits_for_a_bound_write_and_is_waited_for) {
    Recording recording = with_buffers({"a", "b"});
    recording.dispatch(fill("a"));
    recording.dispatch(gather("a", "b"));
    recording.dispatch(fill("a"));
    EXPECT_EQ(derive_barriers(recording, kUnmapped),
              (std::vector{hazard(1, "a", read_after_write, Stage::compute, Stage::compute),
                           hazard(2, "a", write_after_read, Stage::compute, Stage::compute)}));
}

TEST(Barriers, write_after_write_by_address_waits) {
    Recording recording = with_buffers({"a", "b"});
    recording.dispatch(scatter("b", "a"));
    recording.dispatch(scatter("b", "a"));
    recording.dispatch(stir("a"));
    EXPECT_EQ(derive_barriers(recording, kUnmapped),
              (std::vector{hazard(1, "a", write_after_write, Stage::compute, Stage::compute),
                           hazard(2, "a", read_after_write, Stage::compute, Stage::compute)}));
}

// Negative control of the three above: pointers that are only read order nothing.
TEST(Barriers, reads_by_address_need_none_among_themselves) {
    Recording recording = with_buffers({"a", "b", "c", "d"});
    recording.dispatch(gather("a", "b"));
    recording.dispatch(gather("a", "c"));
    recording.dispatch(copy("a", "d"));
    EXPECT_TRUE(derive_barriers(recording, kUnmapped).empty());
}

TEST(Barriers, transfer_amid_uses_by_address_is_not_direct) {
    const std::array<std::byte, 4> word{};
    Recording recording = with_buffers({"a", "b", "c"});
    recording.dispatch(gather("a", "b"));
    recording.upload("a", word);
    recording.upload("c", word);
    recording.readback("c");
    recording.readback("a");
    recording.dispatch(scatter("b", "a"));
    EXPECT_FALSE(is_direct_transfer(recording, 1, kMapped));
    EXPECT_TRUE(is_direct_transfer(recording, 2, kMapped));
    EXPECT_TRUE(is_direct_transfer(recording, 3, kMapped));
    EXPECT_FALSE(is_direct_transfer(recording, 4, kMapped));
}

// The oracle: which command accesses what, by brute force over all pairs of commands.
struct Touch {
    std::string buffer;
    Stage stage;
    bool writes;
};

std::vector<Touch> touches(const Command& command) {
    if (const auto* upload = std::get_if<Upload>(&command)) return {{upload->buffer, Stage::transfer, true}};
    if (const auto* clear = std::get_if<Clear>(&command)) return {{clear->buffer, Stage::transfer, true}};
    if (const auto* readback = std::get_if<Readback>(&command))
        return {{readback->buffer, Stage::transfer, false}};
    const auto* indirect = std::get_if<DispatchIndirect>(&command);
    const Dispatch& dispatch = indirect != nullptr ? indirect->dispatch : std::get<Dispatch>(command);
    std::vector<Touch> all;
    if (indirect != nullptr) all.push_back({indirect->arguments, Stage::indirect, false});
    for (const Binding& binding : dispatch.bindings)
        all.push_back({binding.buffer, Stage::compute, binding.block != "In"});
    for (const Address& address : dispatch.addresses)
        all.push_back({address.buffer, Stage::compute, address.member != "from"});
    return all;
}

// True when the barriers between the commands, followed from stage to stage, put the first ahead of the
// second.
bool is_ordered(std::size_t first, Stage from, std::size_t second, Stage to,
                const std::vector<Hazard>& barriers) {
    std::set<Stage> reached;
    for (const Hazard& barrier : barriers) {
        if (barrier.command <= first || barrier.command > second) continue;
        const bool covers =
            barrier.before == from || (barrier.before == Stage::compute && from == Stage::indirect);
        if (covers || reached.contains(barrier.before)) reached.insert(barrier.after);
    }
    return reached.contains(to);
}

int count_races(const Recording& recording, const std::vector<Hazard>& barriers) {
    int races = 0;
    const auto& commands = recording.commands();
    for (std::size_t second = 0; second < commands.size(); ++second) {
        for (std::size_t first = 0; first < second; ++first) {
            for (const Touch& a : touches(commands[first])) {
                for (const Touch& b : touches(commands[second])) {
                    if (a.buffer != b.buffer || (!a.writes && !b.writes)) continue;
                    races += is_ordered(first, a.stage, second, b.stage, barriers) ? 0 : 1;
                }
            }
        }
    }
    return races;
}

Recording random_recording(std::mt19937& random) {
    Recording recording = with_buffers({"a", "b", "c", "d"});
    const auto any = [&] { return std::string(1, static_cast<char>('a' + random() % 4)); };
    const std::array<std::byte, 4> word{};
    for (int i = 0; i < 12; ++i) {
        switch (random() % 8) {
            case 0:
                recording.upload(any(), word);
                break;
            case 1:
                recording.clear(any());
                break;
            case 2:
                recording.readback(any());
                break;
            case 3:
                recording.dispatch_indirect(scatter(any(), any()), any());
                break;
            case 4:
                recording.dispatch(fill(any()));
                break;
            case 5:
                recording.dispatch(random() % 2 == 0 ? update(any()) : stir(any()));
                break;
            case 6:
                recording.dispatch(gather(any(), any()));
                break;
            default:
                recording.dispatch(copy(any(), any()));
                break;
        }
    }
    return recording;
}

TEST(Barriers, random_recordings_have_no_race) {
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        const Recording recording = random_recording(random);
        ASSERT_EQ(count_races(recording, derive_barriers(recording, kUnmapped)), 0) << describe(recording);
    }
}

// Negative control: without one of its barriers a recording has a race, so the oracle works and no barrier is
// idle.
TEST(Barriers, random_recordings_race_without_any_one_barrier) {
    std::mt19937 random(8);
    int removed = 0;
    int caught = 0;
    for (int i = 0; i < 500; ++i) {
        const Recording recording = random_recording(random);
        const std::vector<Hazard> all = derive_barriers(recording, kUnmapped);
        std::set<std::tuple<std::size_t, Stage, Stage>> distinct;
        for (const Hazard& one : all)
            distinct.insert({one.command, one.before, one.after});
        for (const auto& gone : distinct) {
            std::vector<Hazard> rest = all;
            std::erase_if(rest, [&](const Hazard& one) {
                return std::tuple(one.command, one.before, one.after) == gone;
            });
            ++removed;
            caught += count_races(recording, rest) > 0 ? 1 : 0;
        }
    }
    // Barriers that only a chain of other barriers replaces are kept on purpose; they are few.
    EXPECT_GT(caught, removed * 9 / 10) << caught << " of " << removed;
}

}  // namespace
}  // namespace voxilux
