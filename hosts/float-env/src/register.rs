//! The register that controls how the processor rounds, what it does with subnormal numbers, and
//! which exceptions interrupt the program.

use std::arch::asm;

/// The content of the register, as wide as it is.
#[cfg(any(target_arch = "x86_64", target_arch = "x86"))]
pub(crate) type Word = u32;

/// The content of the register, as wide as it is.
#[cfg(target_arch = "aarch64")]
pub(crate) type Word = u64;

/// The bits of MXCSR that control: DAZ (6), the masks of exceptions (7 to 12), the rounding mode
/// (13 and 14) and FTZ (15). The lowest six are the flags of exceptions, those above are reserved.
#[cfg(any(target_arch = "x86_64", target_arch = "x86"))]
pub(crate) const CONTROL: Word = 0xffc0;

/// Exceptions masked, to nearest, neither FTZ nor DAZ.
#[cfg(any(target_arch = "x86_64", target_arch = "x86"))]
pub(crate) const DEFAULT: Word = 0x1f80;

/// All bits of FPCR control; the flags of exceptions are in another register, FPSR.
#[cfg(target_arch = "aarch64")]
pub(crate) const CONTROL: Word = Word::MAX;

/// No traps, to nearest, no flush to zero, and none of the alternative behaviours.
#[cfg(target_arch = "aarch64")]
pub(crate) const DEFAULT: Word = 0;

/// MXCSR.
#[cfg(any(target_arch = "x86_64", target_arch = "x86"))]
#[inline(always)]
pub(crate) fn read() -> Word {
    let mut word: Word = 0;
    // SAFETY: every x86 processor with SSE, which the target requires, has the instruction. It
    // writes four bytes, to a variable of that size, and changes nothing else.
    unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut word, options(nostack, preserves_flags)) };
    word
}

/// Writes MXCSR.
///
/// # Safety
///
/// No reserved bit is set: so it is for a word of [`read`] in which control bits have changed. And
/// no floating-point operation of Rust code follows until the control bits are the default again.
#[cfg(any(target_arch = "x86_64", target_arch = "x86"))]
#[inline(always)]
pub(crate) unsafe fn write(word: Word) {
    // SAFETY: the instruction reads four bytes, of a variable of that size. It faults on reserved
    // bits alone, of which the caller says that none is set. It does not raise an exception whose
    // flag is set and whose mask is not.
    unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const word, options(nostack)) };
}

/// FPCR.
#[cfg(target_arch = "aarch64")]
#[inline(always)]
pub(crate) fn read() -> Word {
    let word: Word;
    // SAFETY: programs may read the register, and this changes nothing else.
    unsafe { asm!("mrs {}, fpcr", out(reg) word, options(nostack, preserves_flags)) };
    word
}

/// Writes FPCR.
///
/// # Safety
///
/// The word is one of [`read`] in which control bits have changed. And no floating-point operation
/// of Rust code follows until the control bits are the default again.
#[cfg(target_arch = "aarch64")]
#[inline(always)]
pub(crate) unsafe fn write(word: Word) {
    // SAFETY: programs may write the register; bits that it does not have are ignored.
    unsafe { asm!("msr fpcr, {}", in(reg) word, options(nostack)) };
}
