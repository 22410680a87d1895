//! The retain store keeps all of a record or none, whatever happens to the power and to the flash.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use embassy_futures::block_on;
use grafcet_core::program::{Bit, Retained, Slot};
use plc::record::Values;
use plc::retain::{Error, Store};
use proptest::prelude::*;
use support::nor::{Nor, Refusal, Tear};

const SECTOR: usize = 256;
const SECTORS: usize = 4;
const AREA: std::ops::Range<u32> = 0..(SECTOR * SECTORS) as u32;
const FINGERPRINT: u32 = 0x0123_4567;

type Flash = Nor<SECTOR>;
type Content = Option<Vec<(u32, i32)>>;

fn rows(count: usize) -> Vec<Retained> {
    let row = |index| Retained {
        slot: Slot::Bit(Bit(index as u16)),
        key: 0x9e37_79b9_u32.wrapping_mul(index as u32 + 1),
    };
    (0..count).map(row).collect()
}

fn content(values: &[i32]) -> Content {
    let rows = rows(values.len());
    let pairs = rows.iter().map(|row| row.key).zip(values.iter().copied());
    Some(pairs.collect())
}

fn load(flash: Flash) -> (Content, Store<Flash>) {
    let mut store = Store::new(flash, AREA);
    let record = block_on(store.load()).expect("the flash works");
    let content = record.map(|record| record.values.iter().collect());
    (content, store)
}

fn save(store: &mut Store<Flash>, values: &[i32]) -> Result<(), Error<Refusal>> {
    let rows = rows(values.len());
    block_on(store.save(FINGERPRINT, Values::Running(&rows, values)))
}

/// The values of record `number`: all different from those of its neighbours.
fn values(number: i32) -> [i32; 4] {
    [number, -number, number << 16, i32::from(number % 2 == 0)]
}

#[test]
fn an_erased_flash_holds_nothing() {
    assert_eq!(load(Flash::new(SECTORS)).0, None);
}

#[test]
fn the_newest_record_is_found_again_through_many_turns_of_the_area() {
    let mut flash = Flash::new(SECTORS);
    for number in 0..200 {
        let (before, mut store) = load(flash);
        assert_eq!(
            before,
            (number > 0).then(|| content(&values(number - 1))).flatten()
        );
        save(&mut store, &values(number)).expect("there is room");
        flash = store.into_flash();
    }
    assert!(
        flash.erased > 8,
        "the test should make the store erase, not only append"
    );
}

#[test]
fn a_power_cut_at_any_byte_leaves_the_old_record_or_the_new_one() {
    let tears = [Tear::InOrder, Tear::Scattered(1), Tear::Scattered(2)];
    let mut store = load(Flash::new(SECTORS)).1;
    save(&mut store, &values(0)).expect("there is room");
    let mut flash = store.into_flash();
    let mut cuts = 0;
    for number in 1..30 {
        for tear in tears {
            for bytes in 0.. {
                let cut = flash.clone().cut_after(bytes, tear);
                let Some(after) = cut_while_saving(cut, number) else {
                    break;
                };
                cuts += 1;
                old_or_new_and_still_working(after, number);
            }
        }
        let mut store = load(flash).1;
        save(&mut store, &values(number)).expect("there is room");
        flash = store.into_flash();
    }
    assert!(cuts > 3_000, "only {cuts} cuts");
}

/// The flash after power was lost while record `number` was written; none when it was written before that.
fn cut_while_saving(flash: Flash, number: i32) -> Option<Flash> {
    let mut store = load(flash).1;
    match save(&mut store, &values(number)) {
        Ok(()) => None,
        Err(Error::Flash(Refusal::Off)) => Some(store.into_flash().power_on()),
        Err(error) => panic!("record {number}: {error:?}"),
    }
}

fn old_or_new_and_still_working(flash: Flash, number: i32) {
    let (old, new) = (content(&values(number - 1)), content(&values(number)));
    // Power fails again while the damage is mended.
    let mut store = Store::new(flash.cut_after(SECTOR / 3, Tear::Scattered(3)), AREA);
    let _ = block_on(store.load());
    let (found, mut store) = load(store.into_flash().power_on());
    assert!(found == old || found == new, "record {number}: {found:?}");
    for further in [number + 1000, number + 2000, number + 3000] {
        save(&mut store, &values(further)).expect("there is room");
        let (found, again) = load(store.into_flash());
        assert_eq!(found, content(&values(further)));
        store = again;
    }
}

#[test]
fn a_record_longer_than_a_sector_is_refused_and_the_old_one_stays() {
    let mut store = load(Flash::new(SECTORS)).1;
    save(&mut store, &values(1)).expect("there is room");
    assert_eq!(save(&mut store, &[i32::MIN; 40]), Err(Error::TooLong));
    assert_eq!(load(store.into_flash()).0, content(&values(1)));
}

#[test]
fn an_area_of_fewer_than_four_sectors_is_refused() {
    let mut store = Store::new(Flash::new(3), 0..(3 * SECTOR) as u32);
    assert!(matches!(block_on(store.load()), Err(Error::Area)));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn whatever_lies_in_the_area_the_store_comes_up_and_works(
        bytes in proptest::collection::vec(any::<u8>(), SECTOR * SECTORS),
        marks in any::<[Option<bool>; 2 * SECTORS]>(),
    ) {
        let mut store = load(Flash::holding(marked(bytes, marks))).1;
        for number in 0..12 {
            save(&mut store, &values(number)).expect("there is room");
            let (found, again) = load(store.into_flash());
            prop_assert_eq!(found, content(&values(number)));
            store = again;
        }
    }

    #[test]
    fn damage_anywhere_costs_at_most_the_newest_record(
        count in 2..40_i32,
        place in 0..SECTOR * SECTORS,
        damage in 1..=u8::MAX,
    ) {
        let mut store = load(Flash::new(SECTORS)).1;
        for number in 0..count {
            save(&mut store, &values(number)).expect("there is room");
        }
        let mut flash = store.into_flash();
        flash.bytes[place] ^= damage;
        let found = load(flash).0;
        prop_assert!(
            found == content(&values(count - 1)) || found == content(&values(count - 2)),
            "{:?}", found
        );
    }
}

/// Random bytes whose sectors begin and end like sectors in use, or erased ones.
fn marked(mut bytes: Vec<u8>, marks: [Option<bool>; 2 * SECTORS]) -> Vec<u8> {
    let ends = bytes.chunks_exact_mut(SECTOR).flat_map(|sector| {
        let (first, rest) = sector.split_first_mut().expect("a sector is not empty");
        [first, rest.last_mut().expect("a sector has an end")]
    });
    for (end, mark) in ends.zip(marks) {
        if let Some(erased) = mark {
            *end = if erased { 0xff } else { 0 };
        }
    }
    bytes
}
