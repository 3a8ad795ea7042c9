// Preloaded in the guest: does what Bochs refuses. Bochs 2.7 takes the bit that makes a gather's
// index one of zmm16 to zmm31 (EVEX.V') for a part of vvvv, which a gather must not have, and
// raises #UD. This handler of SIGILL does vgatherdps and vpgatherdd with such an index as Intel's
// manual has them (volume 2: VGATHERDPS, 2.7 "EVEX"), on the registers that the kernel has saved
// (volume 1, 13.4 "XSAVE area"); any other instruction ends the program as ever.
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include <ucontext.h>

namespace {

long gathers = 0;

// The vector registers within an XSAVE area in its standard form.
class Vectors {
public:
    explicit Vectors(std::uint8_t* area) : area_(area) {}

    std::uint8_t* lane(unsigned reg, unsigned i) {
        if (reg >= 16) return component(7, 1664, 1024) + 64 * (reg - 16) + 4 * i;
        if (i >= 8) return component(6, 1152, 512) + 32 * reg + 4 * (i - 8);
        if (i >= 4) return component(2, 576, 256) + 16 * reg + 4 * (i - 4);
        return component(1, 160, 256) + 16 * reg + 4 * i;
    }
    std::uint8_t* mask(unsigned reg) { return component(5, 1088, 64) + 8 * reg; }

private:
    // What is all zero need not have been saved.
    std::uint8_t* component(int number, std::size_t offset, std::size_t size) {
        std::uint8_t& saved = area_[512];
        if ((saved >> number & 1) == 0) std::memset(area_ + offset, 0, size);
        saved = static_cast<std::uint8_t>(saved | 1 << number);
        return area_ + offset;
    }

    std::uint8_t* area_;
};

template <class T>
T load(const void* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

// True if it was one of those gathers, and is done.
bool gather(mcontext_t& cpu) {
    static constexpr int kOrder[] = {REG_RAX, REG_RCX, REG_RDX, REG_RBX, REG_RSP, REG_RBP,
                                     REG_RSI, REG_RDI, REG_R8,  REG_R9,  REG_R10, REG_R11,
                                     REG_R12, REG_R13, REG_R14, REG_R15};
    const auto* code = reinterpret_cast<const std::uint8_t*>(cpu.gregs[REG_RIP]);
    // 62, R X B R' of map 0F38, W = 0 vvvv = none pp = 66, z = 0 L'L b = 0 V' = 16 aaa, opcode,
    // ModRM, SIB; the bits of register numbers are inverted.
    const bool ours = code[0] == 0x62 && (code[1] & 0x0f) == 2 && code[2] == 0x7d &&
                      (code[3] & 0x98) == 0 && (code[4] == 0x90 || code[4] == 0x92) &&
                      (code[5] & 7) == 4 && code[5] < 0xc0;
    if (!ours) return false;
    const unsigned high = ~static_cast<unsigned>(code[1]);
    const unsigned mode = code[5] >> 6;
    const unsigned target = (code[5] >> 3 & 7) | (high >> 4 & 8) | (high & 16);
    const unsigned index = (code[6] >> 3 & 7) | (high >> 3 & 8) | 16;
    const unsigned base = (code[6] & 7) | (high >> 2 & 8);
    const unsigned lanes = 4U << (code[3] >> 5 & 3);
    const bool no_base = mode == 0 && (base & 7) == 5;
    std::int64_t start = no_base ? 0 : cpu.gregs[kOrder[base]];
    int length = 7;
    if (mode == 1) {
        start += 4 * load<std::int8_t>(code + 7); // in elements
        length += 1;
    } else if (mode == 2 || no_base) {
        start += load<std::int32_t>(code + 7);
        length += 4;
    }
    Vectors vectors(reinterpret_cast<std::uint8_t*>(cpu.fpregs));
    const auto mask = load<std::uint64_t>(vectors.mask(code[3] & 7));
    for (unsigned i = 0; i < 16; ++i) {
        std::uint32_t value = i < lanes ? load<std::uint32_t>(vectors.lane(target, i)) : 0;
        if (i < lanes && (mask >> i & 1) != 0) {
            const std::int64_t at = load<std::int32_t>(vectors.lane(index, i));
            value =
                load<std::uint32_t>(reinterpret_cast<const void*>(start + (at << (code[6] >> 6))));
        }
        std::memcpy(vectors.lane(target, i), &value, sizeof value);
    }
    std::memset(vectors.mask(code[3] & 7), 0, 8);
    cpu.gregs[REG_RIP] += length;
    return true;
}

void on_illegal_instruction(int signal, siginfo_t*, void* context) {
    if (gather(static_cast<ucontext_t*>(context)->uc_mcontext))
        ++gathers;
    else
        std::signal(signal, SIG_DFL); // and again, for good
}

[[gnu::constructor]] void install() {
    struct sigaction action = {};
    action.sa_sigaction = on_illegal_instruction;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGILL, &action, nullptr);
}

[[gnu::destructor]] void report() {
    if (gathers > 0) std::fprintf(stderr, "%ld gathers were done by gather.cpp\n", gathers);
}

} // namespace
