//! Power fails at every word that the flash programs, at the beginning, within and at the end of every erase, and again
//! while the damage is mended: each variable then has the old value or the new one, and the new one when its write was
//! completed.
//!
//! Stores live through random lives: records of other lengths, other programs, erasing at start and in between. In
//! every moment of such a life all cuts are tried, each on a copy of the flash; the life goes on from one of what they left,
//! or from where nothing was cut. `RETAIN_CUTS=1000000` in the environment asks for another number of cuts than 20 000, as
//! `script/fuzz cuts` does.

#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

mod support;

use embassy_futures::block_on;
use fastrand::Rng;
use plc::retain::{Error, Store};
use support::nor::{Nor, Operation, Refusal, Tear};
use support::records::{Content, content, load, save, start};

/// Three pages, so that some records take more than one.
const SECTOR: usize = 768;
const SECTORS: usize = 4;

const CUTS: usize = 20_000;

/// Words of the flash: what is programmed or not.
const WORD: usize = 4;

/// At how many places an erase is cut.
const PARTS_OF_AN_ERASE: usize = 16;

type Flash = Nor<SECTOR>;

/// What a controller does between two looks at it.
#[derive(Clone, Debug)]
enum Moment {
    /// It starts, and stores this.
    Start(Vec<i32>),
    /// It has been running, stores this, and erases a sector.
    Quiet(Vec<i32>),
    /// It stores this, and then that.
    Two(Vec<i32>, Vec<i32>),
}

/// Which of the values may be there after the power has failed.
#[derive(Debug)]
struct Allowed {
    old: Content,
    /// The one that was being written, if any was.
    new: Content,
}

#[test]
fn a_cut_at_every_operation_leaves_the_old_values_or_the_new_ones_and_what_was_completed() {
    let wanted = std::env::var("RETAIN_CUTS").map_or(CUTS, |it| it.parse().expect("a number"));
    let mut cuts = 0;
    let mut seen = [0; 3];
    let mut lives = 0;
    while cuts < wanted {
        let mut life = Life::new(lives);
        for _ in 0..40 {
            life.moment();
        }
        cuts += life.cuts;
        for (total, seen) in seen.iter_mut().zip(life.seen) {
            *total += seen;
        }
        lives += 1;
    }
    let [old, new, completed] = seen;
    println!(
        "{cuts} cuts in {lives} lives: {old} left the old values, {new} the new ones, {completed} came behind the write"
    );
    assert!(old > wanted / 10 && new > wanted / 100 && completed > wanted / 100);
}

struct Life {
    seed: u64,
    random: Rng,
    flash: Flash,
    held: Content,
    cuts: usize,
    /// Cuts that left the old values, the new ones, and that came behind the completed write.
    seen: [usize; 3],
}

impl Life {
    fn new(seed: u64) -> Self {
        Life {
            seed,
            random: Rng::with_seed(seed),
            flash: Flash::new(SECTORS),
            held: None,
            cuts: 0,
            seen: [0; 3],
        }
    }

    /// Tries every cut of a random moment, and goes on.
    fn moment(&mut self) {
        let moment = self.some_moment();
        let (flash, allowed) = lived(self.flash.clone().power_on(), &self.held, &moment);
        let places = places(&flash.done);
        let mut next = (flash, allowed.old);
        let chosen = self.random.usize(..2 * places.len().max(1));
        for (index, bytes) in places.into_iter().enumerate() {
            let tear = match self.random.u8(..3) {
                0 => Tear::InOrder,
                _ => Tear::Scattered(self.random.u64(..)),
            };
            let left = self.cut(&moment, bytes, tear);
            if index == chosen {
                next = left;
            }
        }
        (self.flash, self.held) = next;
    }

    /// Cuts the power in a moment. The answer is the flash as it is then, and what it holds.
    fn cut(&mut self, moment: &Moment, bytes: usize, tear: Tear) -> (Flash, Content) {
        let whole = self.flash.clone().power_on();
        let (torn, allowed) = lived(whole.cut_after(bytes, tear), &self.held, moment);
        self.cuts += 1;
        let mut left = torn.power_on();
        if self.random.u8(..4) == 0 {
            // Power fails again while the controller starts.
            let bytes = self.random.usize(..2 * SECTOR);
            let tear = Tear::Scattered(self.random.u64(..));
            left = start(left.cut_after(bytes, tear)).1.into_flash().power_on();
        }
        let (found, mut store) = start(left.clone());
        let told = || {
            format!(
                "seed {}: {moment:?} cut after {bytes} bytes, {tear:?}",
                self.seed
            )
        };
        assert!(
            found == allowed.old || found == allowed.new,
            "{}: found {found:?}, not {allowed:?}",
            told()
        );
        let kind = match (&allowed.new, found == allowed.old) {
            (None, _) => 2,
            (Some(_), true) => 0,
            (Some(_), false) => 1,
        };
        self.seen[kind] += 1;
        // The store works, and has not lost its way.
        let further = [bytes as i32, self.cuts as i32];
        assert_eq!(save(&mut store, &further), Ok(()), "{}", told());
        assert_eq!(load(store.into_flash()).0, content(&further), "{}", told());
        (left, found)
    }

    fn some_moment(&mut self) -> Moment {
        match self.random.u8(..4) {
            0 => Moment::Quiet(self.some_values()),
            1 => Moment::Two(self.some_values(), self.some_values()),
            _ => Moment::Start(self.some_values()),
        }
    }

    /// Mostly few; sometimes more than a page takes.
    fn some_values(&mut self) -> Vec<i32> {
        let most = if self.random.u8(..6) == 0 { 60 } else { 12 };
        let count = self.random.usize(1..=most);
        let random = &mut self.random;
        (0..count)
            .map(|_| random.i32(..) >> random.u8(..31))
            .collect()
    }
}

/// What is left when a flash has gone through a moment, or as far as its power went.
fn lived(flash: Flash, held: &Content, moment: &Moment) -> (Flash, Allowed) {
    let mut allowed = Allowed {
        old: held.clone(),
        new: None,
    };
    let mut store = match moment {
        Moment::Start(_) => start(flash).1,
        Moment::Quiet(_) | Moment::Two(..) => load(flash).1,
    };
    match moment {
        Moment::Start(values) => write(&mut store, values, &mut allowed),
        Moment::Quiet(values) => {
            write(&mut store, values, &mut allowed);
            let _ = block_on(store.erase_spent());
        }
        Moment::Two(first, second) => {
            write(&mut store, first, &mut allowed);
            if allowed.new.is_none() {
                write(&mut store, second, &mut allowed);
            }
        }
    }
    (store.into_flash(), allowed)
}

/// Writes a record, and notes what may be there should power fail meanwhile.
fn write(store: &mut Store<Flash>, values: &[i32], allowed: &mut Allowed) {
    match save(store, values) {
        Ok(()) => allowed.old = content(values),
        // Without power it may have come as far as that.
        Err(Error::Flash(Refusal::Off)) => allowed.new = content(values),
        // It was not begun.
        Err(Error::NoStock) => {}
        Err(error) => panic!("{error:?}"),
    }
}

/// After how many bytes power is to fail: before and behind each word that is programmed, and within erases.
fn places(done: &[Operation]) -> Vec<usize> {
    let mut places = Vec::new();
    let mut before = 0;
    for operation in done {
        let (length, step) = match *operation {
            Operation::Program(length) => (length, WORD),
            Operation::Erase(length) => (length, length / PARTS_OF_AN_ERASE),
        };
        places.extend((0..length).step_by(step).map(|at| before + at));
        // But for the last byte; and finished, but nobody knows.
        places.extend([before + length - 1, before + length]);
        before += length;
    }
    places
}
