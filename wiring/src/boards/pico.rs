//! The Raspberry Pi Pico: an RP2040 with 2 MiB of flash (Raspberry Pi Pico Datasheet, chapter 2).

use crate::board::{Board, Pin, Purpose};

/// The Raspberry Pi Pico.
pub static PICO: Board = Board {
    name: "pico",
    title: "Raspberry Pi Pico",
    pins: PINS,
    flash_bytes: 2 * 1024 * 1024,
    sector_bytes: 4096,
    // W25Q16JV: 45 ms typically.
    erase_ms: 400,
    // The counter has 24 bits and loses two every microsecond (RP2040-E1): 8.3 s.
    watchdog_limit_ms: 8_000,
};

const fn pin(name: &'static str, peripheral: &'static str, purpose: Purpose) -> Pin {
    Pin {
        name,
        peripheral,
        purpose,
        analogue: false,
    }
}

/// A pin that the converter's multiplexer reaches.
const fn analogue(name: &'static str, peripheral: &'static str, purpose: Purpose) -> Pin {
    Pin {
        analogue: true,
        ..pin(name, peripheral, purpose)
    }
}

const PINS: &[Pin] = &[
    pin("GP2", "PIN_2", Purpose::Free),
    pin("GP3", "PIN_3", Purpose::Free),
    pin("GP4", "PIN_4", Purpose::Free),
    pin("GP5", "PIN_5", Purpose::Free),
    pin("GP6", "PIN_6", Purpose::Free),
    pin("GP7", "PIN_7", Purpose::Free),
    pin("GP8", "PIN_8", Purpose::Free),
    pin("GP9", "PIN_9", Purpose::Free),
    pin("GP10", "PIN_10", Purpose::Free),
    pin("GP11", "PIN_11", Purpose::Free),
    pin("GP12", "PIN_12", Purpose::Free),
    pin("GP13", "PIN_13", Purpose::Free),
    pin("GP14", "PIN_14", Purpose::Free),
    pin("GP15", "PIN_15", Purpose::Free),
    pin("GP16", "PIN_16", Purpose::Free),
    pin("GP17", "PIN_17", Purpose::Free),
    pin("GP18", "PIN_18", Purpose::Free),
    pin("GP19", "PIN_19", Purpose::Free),
    pin("GP20", "PIN_20", Purpose::Free),
    pin("GP21", "PIN_21", Purpose::Free),
    pin("GP22", "PIN_22", Purpose::Free),
    pin(
        "GP23",
        "PIN_23",
        Purpose::Reserved("it switches the board's power supply"),
    ),
    pin(
        "GP24",
        "PIN_24",
        Purpose::Reserved("it senses the USB supply"),
    ),
    pin(
        "GP25",
        "PIN_25",
        Purpose::Output("it lights the LED on the board"),
    ),
    analogue("GP26", "PIN_26", Purpose::Free),
    analogue("GP27", "PIN_27", Purpose::Free),
    analogue("GP28", "PIN_28", Purpose::Free),
    analogue(
        "GP29",
        "PIN_29",
        Purpose::AnalogueInput("it measures the supply voltage, a third of it"),
    ),
    // Last to be proposed: the serial line's usual place.
    pin("GP0", "PIN_0", Purpose::Free),
    pin("GP1", "PIN_1", Purpose::Free),
];
