//! What a `plc.toml` must keep to, each rule with the name that its diagnostics carry.

use grafcet_compiler::diagnostic::{Level, NamedRule};

/// What is wrong with a `plc.toml`, shown as the compiler shows what is wrong with a program.
pub type Diagnostic = grafcet_compiler::diagnostic::Diagnostic<Rule>;

macro_rules! rules {
    ($($(#[$doc:meta])* $variant:ident $name:literal;)*) => {
        /// The rules. All are errors: a half-wired program is not built.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Rule { $($(#[$doc])* $variant,)* }

        impl Rule {
            /// Every rule.
            pub const ALL: &[Rule] = &[$(Rule::$variant,)*];
        }

        impl NamedRule for Rule {
            fn name(self) -> &'static str {
                match self { $(Rule::$variant => $name,)* }
            }

            fn level(self) -> Level {
                Level::Error
            }
        }
    };
}

rules! {
    /// The file is not TOML, or has a key twice.
    Toml "toml";
    /// A key that means nothing here; the nearest is suggested.
    UnknownKey "unknown-key";
    /// A key that has to be there is not.
    MissingKey "missing-key";
    /// A value of another kind than the key takes, or none of its words.
    BadValue "bad-value";
    /// A duration that cannot be read.
    BadDuration "bad-duration";
    /// A number or duration outside its range.
    OutOfRange "out-of-range";
    /// The application's file cannot be read.
    NoApplication "no-application";
    /// No board by that name.
    UnknownBoard "unknown-board";
    /// No pin by that name on the board.
    UnknownPin "unknown-pin";
    /// A pin that the board needs itself, or that cannot serve as this.
    ReservedPin "reserved-pin";
    /// A pin wired twice; both places shown.
    PinUsedTwice "pin-used-twice";
    /// A key that is no address.
    BadAddress "bad-address";
    /// An address wired twice; both places shown.
    DuplicateAddress "duplicate-address";
    /// An address in the wrong table: `%I` lies under `[inputs]`, `%Q` under `[outputs]`.
    AddressDirection "address-direction";
    /// Nothing of the program lies at the address.
    UnknownAddress "unknown-address";
    /// An input or output of the program without a pin.
    NotWired "not-wired";
    /// A scale without length, or one that reaches beyond the range of its variable.
    BadScale "bad-scale";
    /// A numeric output, which no pin of this board can carry yet.
    NumberAtPin "number-at-pin";
    /// More retained values than one record of the store takes.
    RetainTooBig "retain-too-big";
}
