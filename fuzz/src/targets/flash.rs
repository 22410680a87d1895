//! Flash pages: whatever lies in the area of the retain store, and wherever power fails while that is mended, the store
//! comes up, a program starts with values that it can hold, and the next record is kept.
//!
//! An input is six bytes that say where power fails and how the flash is left then, and the content of the area.

use embassy_futures::block_on;
use grafcet_compiler::application::Tables;
use grafcet_compiler::{Target, compile};
use grafcet_core::engine::Engine;
use grafcet_core::program::Names;
use grafcet_core::vectors::Vectors;
use plc::boards::host::lines::keep;
use plc::boot::{Cause, boot};
use plc::record::Values;
use plc::retain::Store;
use plc::store::prepare;
use std::sync::LazyLock;

use super::nor::{Nor, Tear};

const SECTOR: usize = 256;
const SECTORS: usize = 4;
/// What may still be written; not what is tried here.
const CREDIT: u16 = 7;
const SIZE: usize = SECTOR * SECTORS;
const HEAD: usize = 6;

type Flash = Nor<SECTOR>;

/// A program that keeps a Boolean, a number with a range and an operator's time.
const PROGRAM: &str = "\
input a
retain var seen
retain var count : int in -5 .. 1000
parameter delay : time = 1s in 100ms .. 10s
graph G {
    initial step 1 { seen = TRUE IF a; count = count + 1 IF \u{2191}a }
    step 2
    transition 1: 1 -> 2 when T/X1/delay
    transition 2: 2 -> 1
}
";

static TABLES: LazyLock<Option<Tables>> = LazyLock::new(|| {
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = compile("fuzz.grafcet", PROGRAM, &none, Target::Host);
    compilation.application.map(|it| it.controller.tables)
});

const NAMES: Names<'static> = Names {
    application: "fuzz",
    graphs: &["G"],
    steps: &["1", "2"],
    transitions: &[1, 2],
    retained: &["seen", "count", "delay"],
};

/// The log says what was found; nobody reads it here.
pub(crate) fn run(input: &[u8]) {
    keep(|| comes_up(input));
}

fn comes_up(input: &[u8]) {
    let Some(tables) = &*TABLES else {
        panic!("the program does not compile");
    };
    let (cut, tear, content) = parts(input);
    // Power fails while the store erases what it finds, or while it stores the first record.
    let flash = Flash::holding(content).cut_after(cut, tear);
    let mut store = Store::new(flash, 0..SIZE as u32);
    let _ = block_on(store.load());
    block_on(prepare(&mut store));
    let _ = block_on(store.save(
        tables.fingerprint,
        Values::Running(&tables.retained, &[1, 2, 3]),
        CREDIT,
    ));
    let mut store = Store::new(store.into_flash().power_on(), 0..SIZE as u32);

    let program = tables.program();
    let vectors = Vectors::new(&program);
    let mut engine = Engine::new(&program, vectors);
    block_on(boot(&mut engine, &NAMES, &mut store, Cause::PowerOn));
    block_on(prepare(&mut store));
    engine.start();
    for (row, (low, high)) in tables
        .retained
        .iter()
        .zip([(0, 1), (-5, 1000), (100, 10_000)])
    {
        let value = engine.value(row.slot);
        assert!((low..=high).contains(&value), "{row:?} is {value}");
    }

    for number in 0..12 {
        let values = [number & 1, number, 100 + number];
        let saved = block_on(store.save(
            tables.fingerprint,
            Values::Running(&tables.retained, &values),
            CREDIT,
        ));
        assert_eq!(saved, Ok(()), "record {number}");
        store = Store::new(store.into_flash(), 0..SIZE as u32);
        let record = block_on(store.load());
        let found =
            record.map(|it| it.map(|it| it.values.iter().map(|(_, value)| value).collect()));
        assert_eq!(found, Ok(Some(values.to_vec())), "record {number}");
        block_on(prepare(&mut store));
    }
}

/// Where power fails, how, and what lies in the area: what is missing is erased.
fn parts(input: &[u8]) -> (usize, Tear, Vec<u8>) {
    let mut head = [0xff; HEAD];
    for (to, from) in head.iter_mut().zip(input) {
        *to = *from;
    }
    let [low, high, kind, seed @ ..] = head;
    let cut = usize::from(u16::from_le_bytes([low, high]));
    let seed = seed
        .into_iter()
        .fold(0, |seed, byte| seed << 8 | u64::from(byte));
    let tear = if kind & 1 == 0 {
        Tear::InOrder
    } else {
        Tear::Scattered(seed)
    };
    let mut content = input.get(HEAD..).unwrap_or_default().to_vec();
    content.resize(SIZE, 0xff);
    (cut, tear, content)
}

/// Areas in which many records were stored, whole ones and ones that power was cut from.
pub(crate) fn seeds() -> Vec<Vec<u8>> {
    let Some(tables) = &*TABLES else {
        return Vec::new();
    };
    let mut seeds = vec![vec![0xff; HEAD], vec![0; HEAD + SIZE]];
    for (records, cut) in [
        (1, None),
        (5, None),
        (30, None),
        (3, Some(20)),
        (12, Some(300)),
        (25, Some(7)),
    ] {
        let mut store = Store::new(Flash::new(SECTORS), 0..SIZE as u32);
        let _ = block_on(store.load());
        let save = |store: &mut Store<Flash>, number: i32| {
            let values = [number & 1, number, 100 + number];
            let _ = block_on(store.save(
                tables.fingerprint,
                Values::Running(&tables.retained, &values),
                CREDIT,
            ));
            block_on(prepare(store));
        };
        for number in 0..records {
            save(&mut store, number);
        }
        let mut flash = store.into_flash();
        if let Some(bytes) = cut {
            let mut store = Store::new(flash.cut_after(bytes, Tear::Scattered(7)), 0..SIZE as u32);
            let _ = block_on(store.load());
            save(&mut store, records);
            flash = store.into_flash();
        }
        seeds.push([&[0xff; HEAD][..], &flash.bytes].concat());
        seeds.push([&[40, 0, 1, 2, 3, 4][..], &flash.bytes].concat());
    }
    seeds
}
