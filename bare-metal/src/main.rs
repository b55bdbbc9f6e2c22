//! The scene of `lib.rs` on an ARM Cortex-M4F without anything else: the board `mps2-an386`, as an emulator has it.

#![no_std]
#![no_main]

use core::arch::asm;
use core::fmt::{self, Write};
use core::panic::PanicInfo;
use core::ptr;

use closeranks_bare_metal::{DIGEST, Scene, TICKS, digest};

/// Coprocessor access control register: both bits of 10 and 11 turn the floating-point unit on.
const CPACR: *mut u32 = 0xe000_ed88 as *mut u32;
/// The system timer: control, reload value, current value. It counts 24 bits down.
const SYST_CSR: *mut u32 = 0xe000_e010 as *mut u32;
const SYST_RVR: *mut u32 = 0xe000_e014 as *mut u32;
const SYST_CVR: *mut u32 = 0xe000_e018 as *mut u32;
/// The memory of the board, in which there is nothing but the stack.
const STACK_END: usize = 0x2040_0000;
const MEMORY: core::ops::Range<usize> = 0x2000_0000..STACK_END;
const TIMER_MASK: u32 = 0x00ff_ffff;
/// With one instruction a nanosecond (`-icount shift=0`) and a processor clock of 25 MHz.
const INSTRUCTIONS_A_COUNT: u64 = 40;

/// Where the processor begins (bare-metal.ld puts its address into the vector table).
#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    // SAFETY: these are the registers of every Cortex-M4F, and nothing else runs.
    unsafe {
        ptr::write_volatile(CPACR, ptr::read_volatile(CPACR) | 0x00f0_0000);
        asm!("dsb", "isb");
        ptr::write_volatile(SYST_RVR, TIMER_MASK);
        ptr::write_volatile(SYST_CVR, 0);
        ptr::write_volatile(SYST_CSR, 0b101);
    }
    run()
}

#[inline(never)]
fn run() -> ! {
    let Some(mut scene) = Scene::new() else { stop("the settings were refused\n") };
    let stack_made = stack_used();
    let (mut sum, mut total, mut most) = (DIGEST, 0, 0);
    for _ in 0..TICKS {
        let begin = timer();
        let velocity_m_s = scene.tick();
        let counts = u64::from(begin.wrapping_sub(timer()) & TIMER_MASK);
        (total, most) = (total + counts, counts.max(most));
        sum = velocity_m_s.into_iter().fold(sum, digest);
    }
    sum = digest(sum, scene.value());
    let mean = total * INSTRUCTIONS_A_COUNT / u64::from(TICKS);
    let _ = writeln!(Host, "digest {sum:016x}");
    let _ =
        writeln!(Host, "instructions a tick: {mean} in the mean, {} at most", most * INSTRUCTIONS_A_COUNT);
    let _ = writeln!(Host, "stack: {stack_made} bytes to make the robot, {} bytes at most", stack_used());
    stop("")
}

/// How far the stack ever reached: the emulator's memory is 0 where nobody wrote.
fn stack_used() -> usize {
    // SAFETY: the addresses are those of the memory in bare-metal.ld, which is read and not changed.
    let untouched = |address: &usize| unsafe { ptr::read_volatile(*address as *const u32) == 0 };
    STACK_END - MEMORY.step_by(4).find(|address| !untouched(address)).unwrap_or(STACK_END)
}

fn timer() -> u32 {
    // SAFETY: reading the timer changes nothing that is used.
    unsafe { ptr::read_volatile(SYST_CVR) }
}

/// The machine that emulates the board.
struct Host;

impl Write for Host {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            call(0x03, ptr::from_ref(&byte).addr()); // SYS_WRITEC
        }
        Ok(())
    }
}

fn stop(why: &str) -> ! {
    let _ = Host.write_str(why);
    // SYS_EXIT: "the application exited", or with any other number, that it failed.
    call(0x18, if why.is_empty() { 0x2_0026 } else { 0x2_0023 });
    loop {
        core::hint::spin_loop();
    }
}

fn call(operation: usize, argument: usize) {
    // SAFETY: a semihosting call, which the emulator answers in r0; it reads the byte that the argument points to.
    unsafe { asm!("bkpt 0xab", inout("r0") operation => _, in("r1") argument) }
}

/// The core itself has no input on which it panics.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    stop("panic\n")
}
