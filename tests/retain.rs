//! The retain store keeps all of a record or none, whatever happens to the power and to the flash; and it erases nothing
//! that it was not told to.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use embassy_futures::block_on;
use embedded_storage_async::nor_flash::{ErrorType, NorFlash, ReadNorFlash};
use plc::retain::{Error, PAGE, Store};
use plc::store::prepare;
use proptest::prelude::*;
use support::nor::{Nor, Operation, Refusal, Tear};
use support::records::{Content, content, load, save, start};

const SECTOR: usize = 256;
const SECTORS: usize = 4;
const AREA: std::ops::Range<u32> = 0..(SECTOR * SECTORS) as u32;

type Flash = Nor<SECTOR>;

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
        let (before, mut store) = start(flash);
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
    let mut store = start(Flash::new(SECTORS)).1;
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
        let mut store = start(flash).1;
        save(&mut store, &values(number)).expect("there is room");
        flash = store.into_flash();
    }
    assert!(cuts > 3_000, "only {cuts} cuts");
}

/// The flash after power was lost at start or while record `number` was written; none when it was written before that.
fn cut_while_saving(flash: Flash, number: i32) -> Option<Flash> {
    let mut store = start(flash).1;
    match save(&mut store, &values(number)) {
        Ok(()) => None,
        Err(Error::Flash(Refusal::Off) | Error::NoStock) => Some(store.into_flash().power_on()),
        Err(error) => panic!("record {number}: {error:?}"),
    }
}

fn old_or_new_and_still_working(flash: Flash, number: i32) {
    let (old, new) = (content(&values(number - 1)), content(&values(number)));
    // Power fails again while what is spent is erased.
    let store = start(flash.cut_after(SECTOR / 3, Tear::Scattered(3))).1;
    let (found, mut store) = start(store.into_flash().power_on());
    assert!(found == old || found == new, "record {number}: {found:?}");
    for further in [number + 1000, number + 2000, number + 3000] {
        save(&mut store, &values(further)).expect("there is room");
        let (found, again) = start(store.into_flash());
        assert_eq!(found, content(&values(further)));
        store = again;
    }
}

#[test]
fn nothing_is_written_to_where_a_torn_record_would_have_gone_on() {
    // Of so many lengths one ends with the first byte of a grain.
    let torn = (1..20).flat_map(|count| [1, 2_000].map(|value| vec![value; count]));
    let mut ended_behind_a_grain = false;
    for values in torn {
        let mut store = start(Flash::new(SECTORS)).1;
        save(&mut store, &values).expect("there is room");
        let flash = store.into_flash();
        let Some(&Operation::Program(length)) = flash.done.first() else {
            panic!("nothing was programmed");
        };
        ended_behind_a_grain |= length % 16 == 1;
        let flash = Flash::new(SECTORS).cut_after(length - 1, Tear::InOrder);
        let mut store = start(flash).1;
        assert!(save(&mut store, &values).is_err());
        let (found, mut store) = start(store.into_flash().power_on());
        assert_eq!(found, None);
        save(&mut store, &[1]).expect("there is room");
        let flash = store.into_flash();
        assert_eq!(flash.bytes[length - 1], 0xff, "{length} bytes");
    }
    assert!(ended_behind_a_grain);
}

#[test]
fn nothing_is_erased_to_write_a_record() {
    let mut store = start(Flash::new(SECTORS)).1;
    let mut number = 0;
    let refused = loop {
        match save(&mut store, &values(number)) {
            Ok(()) => number += 1,
            refused => break refused,
        }
    };
    assert_eq!(refused, Err(Error::NoStock));
    assert!(number >= 12, "three sectors take {number} records");
    let flash = store.into_flash();
    assert_eq!((flash.erased, flash.programmed), (0, number as usize));
    assert_eq!(load(flash).0, content(&values(number - 1)));
}

#[test]
fn sectors_are_erased_one_by_one_but_the_one_before_the_active_one_is_kept() {
    let mut store = start(Flash::new(SECTORS)).1;
    let mut number = 0;
    for _ in 0..10 {
        while save(&mut store, &values(number)) == Ok(()) {
            number += 1;
        }
        assert_eq!((store.stock(), store.spent()), (0, SECTORS - 2));
        for left in (0..SECTORS - 2).rev() {
            assert_eq!(block_on(store.erase_spent()), Ok(true));
            assert_eq!(store.spent(), left);
        }
        assert_eq!(block_on(store.erase_spent()), Ok(false));
        let flash = store.into_flash();
        let written = flash.bytes.chunks(SECTOR).filter(|it| it[0] != 0xff);
        assert_eq!(written.count(), 2);
        let (found, again) = load(flash);
        assert_eq!(found, content(&values(number - 1)));
        store = again;
    }
}

#[test]
fn a_record_that_fits_into_a_page_is_one_program_and_a_longer_one_is_one_a_page() {
    type Flash = Nor<4096>;
    let mut store = start(Flash::new(4)).1;
    let mut longest = 0;
    for count in (0..250).step_by(7) {
        let values = vec![i32::MIN; count];
        save(&mut store, &values).expect("there is room");
        prepare_now(&mut store);
        let flash = store.into_flash();
        let programs: Vec<usize> = { flash.done.iter() }
            .filter_map(|it| match it {
                Operation::Program(bytes) => Some(*bytes),
                Operation::Erase(_) => None,
            })
            .collect();
        let length: usize = programs.iter().sum();
        assert_eq!(programs.len(), length.div_ceil(PAGE), "{length} bytes");
        longest = longest.max(length);
        let (found, again) = load(flash.power_on());
        assert_eq!(found, content(&values));
        store = again;
        prepare_now(&mut store);
    }
    assert!(longest > 8 * PAGE, "{longest}");
}

fn prepare_now<const SECTOR: usize>(store: &mut Store<Nor<SECTOR>>) {
    block_on(prepare(store));
}

#[test]
fn start_erases_all_that_is_spent() {
    let mut store = start(Flash::new(SECTORS)).1;
    for number in 0..12 {
        save(&mut store, &values(number)).expect("there is room");
    }
    let store = start(store.into_flash()).1;
    assert_eq!((store.stock(), store.spent()), (SECTORS - 2, 0));
    assert!(store.into_flash().erased > 0);
}

#[test]
fn a_record_longer_than_a_sector_is_refused_and_the_old_one_stays() {
    let mut store = start(Flash::new(SECTORS)).1;
    save(&mut store, &values(1)).expect("there is room");
    assert_eq!(save(&mut store, &[i32::MIN; 40]), Err(Error::TooLong));
    assert_eq!(load(store.into_flash()).0, content(&values(1)));
}

#[test]
fn an_area_of_fewer_than_four_sectors_is_refused() {
    let mut store = Store::new(Flash::new(3), 0..(3 * SECTOR) as u32);
    assert!(matches!(block_on(store.load()), Err(Error::Area)));
}

/// A flash with a bit that cannot be programmed any more.
struct Worn {
    flash: Flash,
    place: usize,
}

impl ErrorType for Worn {
    type Error = Refusal;
}

impl ReadNorFlash for Worn {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refusal> {
        self.flash.read(offset, bytes).await
    }

    fn capacity(&self) -> usize {
        self.flash.capacity()
    }
}

impl NorFlash for Worn {
    const WRITE_SIZE: usize = 1;
    const ERASE_SIZE: usize = SECTOR;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), Refusal> {
        self.flash.erase(from, to).await
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refusal> {
        let written = self.flash.write(offset, bytes).await;
        self.flash.bytes[self.place] |= 4;
        written
    }
}

#[test]
fn a_record_that_cannot_be_read_where_it_was_written_is_written_elsewhere() {
    for place in 0..AREA.len() {
        let flash = Flash::new(SECTORS);
        let mut store = Store::new(Worn { flash, place }, AREA);
        assert!(matches!(block_on(store.load()), Ok(None)));
        for number in 0..20 {
            block_on(prepare(&mut store));
            save(&mut store, &values(number)).expect("there is room elsewhere");
            let found = block_on(store.load()).expect("the flash works");
            let found: Content = found.map(|record| record.values.iter().collect());
            assert_eq!(found, content(&values(number)), "place {place}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn whatever_lies_in_the_area_the_store_comes_up_and_works(
        bytes in proptest::collection::vec(any::<u8>(), SECTOR * SECTORS),
        erased in any::<[bool; 4 * SECTORS]>(),
    ) {
        let mut store = start(Flash::holding(partly_erased(bytes, erased))).1;
        for number in 0..12 {
            save(&mut store, &values(number)).expect("there is room");
            let (found, again) = start(store.into_flash());
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
        let mut flash = Flash::new(SECTORS);
        for number in 0..count {
            let mut store = start(flash).1;
            save(&mut store, &values(number)).expect("there is room");
            flash = store.into_flash();
        }
        flash.bytes[place] ^= damage;
        let found = load(flash).0;
        prop_assert!(
            found == content(&values(count - 1)) || found == content(&values(count - 2)),
            "{:?}", found
        );
    }
}

/// Random bytes, quarters of sectors erased.
fn partly_erased(mut bytes: Vec<u8>, erased: [bool; 4 * SECTORS]) -> Vec<u8> {
    for (part, erased) in bytes.chunks_exact_mut(SECTOR / 4).zip(erased) {
        if erased {
            part.fill(0xff);
        }
    }
    bytes
}
