//! Records of made-up values, in a store of any flash.

use embassy_futures::block_on;
use embedded_storage_async::nor_flash::NorFlash;
use grafcet_core::program::{Bit, Retained, Slot};
use plc::record::Values;
use plc::retain::{Error, Store};
use plc::store::prepare;

use super::nor::Nor;

/// What a record holds, if there is one.
pub type Content = Option<Vec<(u32, i32)>>;

const FINGERPRINT: u32 = 0x0123_4567;
const CREDIT: u16 = 1000;

fn rows(count: usize) -> Vec<Retained> {
    let row = |index| Retained {
        slot: Slot::Bit(Bit(index as u16)),
        key: 0x9e37_79b9_u32.wrapping_mul(index as u32 + 1),
    };
    (0..count).map(row).collect()
}

/// The record that `save` makes of these values.
pub fn content(values: &[i32]) -> Content {
    let rows = rows(values.len());
    let pairs = rows.iter().map(|row| row.key).zip(values.iter().copied());
    Some(pairs.collect())
}

/// The newest record of a flash whose power may fail, and its store.
pub fn load<const SECTOR: usize>(flash: Nor<SECTOR>) -> (Content, Store<Nor<SECTOR>>) {
    let area = 0..flash.bytes.len() as u32;
    let mut store = Store::new(flash, area);
    let record = block_on(store.load()).ok().flatten();
    let content = record.map(|record| record.values.iter().collect());
    (content, store)
}

/// The same, as a controller starts: what is spent is erased.
pub fn start<const SECTOR: usize>(flash: Nor<SECTOR>) -> (Content, Store<Nor<SECTOR>>) {
    let (content, mut store) = load(flash);
    plc::boards::host::lines::keep(|| block_on(prepare(&mut store)));
    (content, store)
}

/// Stores a record of these values.
pub fn save<F: NorFlash>(store: &mut Store<F>, values: &[i32]) -> Result<(), Error<F::Error>> {
    let rows = rows(values.len());
    block_on(store.save(FINGERPRINT, Values::Running(&rows, values), CREDIT))
}
