//! `[retain]`: how much flash retained values have, and what of the program their store is wired to.

use grafcet_compiler::application::VariableSymbol;
use grafcet_compiler::model::{Address, Area, Size};
use grafcet_core::program::{Bit, Slot};

use crate::file::Section;
use crate::rule::{Diagnostic, Rule};
use crate::table::{Placed, Report, Table};

/// The sectors of the retain area when the file names none.
pub const DEFAULT_SECTORS: u32 = 16;
/// One that is written to, one kept, and two erased at least; more of them last longer, and take longer to erase at start.
pub const SECTORS: std::ops::RangeInclusive<u32> = 4..=64;

/// The table.
#[derive(Clone, Debug)]
pub struct Retain {
    /// Sectors of the area.
    pub sectors: u32,
    /// The address of what is True while the flash may be erased.
    pub quiet: Option<Placed<Address>>,
    /// The address of the input that is True while the store needs to erase, or cannot store.
    pub alarm: Option<Placed<Address>>,
}

/// What of the program the store is wired to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StoreWires {
    /// True while the flash may be erased.
    pub quiet: Option<Bit>,
    /// True while the store needs to erase, or cannot store.
    pub alarm: Option<Bit>,
}

/// An end of the store's wires.
#[derive(Clone, Copy)]
enum End {
    Quiet,
    Alarm,
}

impl End {
    fn key(self) -> &'static str {
        match self {
            End::Quiet => "quiet",
            End::Alarm => "alarm",
        }
    }

    fn example(self) -> &'static str {
        match self {
            End::Quiet => "\"%QX1.0\"",
            End::Alarm => "\"%IX1.0\"",
        }
    }

    fn fits(self, address: Address) -> bool {
        let area = match self {
            End::Quiet => [Area::Output, Area::Memory].contains(&address.area),
            End::Alarm => address.area == Area::Input,
        };
        area && matches!(address.size, Size::Bit(_))
    }

    fn wanted(self) -> &'static str {
        match self {
            End::Quiet => "a Boolean output, `%QX`, or a Boolean in memory, `%MX`",
            End::Alarm => "a Boolean input, `%IX`",
        }
    }

    fn declaration(self, address: Address) -> String {
        match self {
            End::Quiet if address.area == Area::Memory => format!("`var quiet at {address}`"),
            End::Quiet => format!("`output QUIET at {address}`"),
            End::Alarm => format!("`input alarm at {address}`"),
        }
    }
}

pub(crate) fn read_retain(top: &Table<'_>, report: &mut Report) -> Retain {
    let mut retain = Retain {
        sectors: DEFAULT_SECTORS,
        quiet: None,
        alarm: None,
    };
    if let Some(table) = top.table("retain", "`[retain]`", report) {
        table.expect_keys(&["sectors", "quiet", "alarm"], report);
        let sectors = table.integer("sectors", SECTORS, "16", " sectors", report);
        retain.sectors = sectors.map_or(DEFAULT_SECTORS, |sectors| sectors.value);
        retain.quiet = read_end(&table, End::Quiet, report);
        retain.alarm = read_end(&table, End::Alarm, report);
    }
    retain
}

fn read_end(table: &Table<'_>, end: End, report: &mut Report) -> Option<Placed<Address>> {
    let text = table.string(end.key(), None, end.example(), report)?;
    let span = text.span;
    let refused = match Address::parse(text.value) {
        Ok(value) if end.fits(value) => return Some(Placed { value, span }),
        Ok(_) => {
            let message = format!("`{}` is {}", end.key(), end.wanted());
            Diagnostic::new(Rule::AddressDirection, span, message)
        }
        Err(message) => Diagnostic::new(Rule::BadAddress, span, message),
    };
    report.push(refused.help(format!(
        "write `{} = {}`, with the address that the program declares",
        end.key(),
        end.example()
    )));
    None
}

impl Retain {
    /// The addresses that the store is wired to: they need no pin.
    pub(crate) fn addresses(&self) -> impl Iterator<Item = Address> {
        let ends = [&self.quiet, &self.alarm];
        ends.into_iter().flatten().map(|end| end.value)
    }

    /// Finds the ends in the program.
    pub(crate) fn join<T>(
        &self,
        variables: &[VariableSymbol],
        inputs: &Section<T>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> StoreWires {
        if let Some(alarm) = &self.alarm
            && let Some(wire) = { &inputs.wires }
                .iter()
                .find(|it| it.address.value == alarm.value)
        {
            let message = format!("`{}` is wired twice", alarm.value);
            diagnostics.push(
                Diagnostic::new(Rule::DuplicateAddress, alarm.span, message)
                    .label(wire.address.span, "to a pin here")
                    .help("the alarm comes from the store; take one of the lines out"),
            );
        }
        let mut find = |end: End, placed: &Option<Placed<Address>>| {
            let address = placed.as_ref()?;
            let bit = variables.iter().find_map(|it| match it.slot {
                Slot::Bit(bit) => {
                    let at = Address::parse(it.address.as_deref()?).ok()?;
                    (at == address.value).then_some(bit)
                }
                Slot::Number(_) => None,
            });
            if bit.is_none() {
                let message = format!("the program has nothing at `{}`", address.value);
                diagnostics.push(
                    Diagnostic::new(Rule::UnknownAddress, address.span, message).help(format!(
                        "declare {} in the program",
                        end.declaration(address.value)
                    )),
                );
            }
            bit
        };
        StoreWires {
            quiet: find(End::Quiet, &self.quiet),
            alarm: find(End::Alarm, &self.alarm),
        }
    }
}
