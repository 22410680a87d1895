//! Rows and tables as Rust expressions.

use grafcet_core::program::{
    Actors, Arm, Armed, Assignment, Bit, Block, Code, Condition, Course, Crossing, Dependent,
    Duties, Edge, Edges, Enclosing, Event, Evolution, Forced, Graph, Layout, Macro, Masks,
    Momentary, Number, NumberRow, Op, Order, Preset, Rest, Retained, Role, Run, Seen, Since, Slot,
    Stamp, Step, Stored, Target, Term, Timer, Transition, Unit, Watch,
};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::application::Tables;

/// What can stand in a program.
pub(super) trait Row {
    /// The expression whose value it is.
    fn literal(&self) -> TokenStream;
}

/// A struct is the literals of its fields. Every field has to be named, so that a new one is not forgotten.
macro_rules! structs {
    ($($type:ident => $name:ident { $($field:ident)* })*) => {$(
        impl Row for $type {
            fn literal(&self) -> TokenStream {
                let $type { $($field),* } = self;
                $(let $field = $field.literal();)*
                quote!($name { $($field: #$field),* })
            }
        }
    )*};
}

structs! {
    Tables => Program {
        period_ms evolution fingerprint layout read_inputs reads_first_scan crosses_at_once marks_all graphs roles hierarchy blocks masks actors steps duties macros transitions crossings do_blocks links arms
        situations enclosings orders sources lasting_in_steps momentary_varies stores_on_change stored events always_stored
        targets momentary always_momentary dependent edges watches trigger_watches round_watches action_watches conditions terms timers codes ops numbers
        initially_true retained
    }
    Layout => Layout {
        words inputs situations macros momentary number_inputs outside numbers stamps since stack fired passed before
        remembered standings shown sets armed
    }
    Graph => Graph {
        steps first_word transitions initial role
    }
    Role => Role { sources enclosings orders self_orders watches self_watches }
    Step => Step { first_arm first_momentary duties arm_count momentary_count }
    Duties => Duties { stored on_activation on_deactivation on_event orders activated since }
    Block => Block { first masks momentary }
    Actors => Actors { momentary masks }
    Masks => Masks { timed stored on_activation on_deactivation on_event forcing varying }
    Arm => Arm { transition course shows next }
    Macro => Macro { bit graph steps activated }
    Transition => Transition { fires term crossing }
    Enclosing => Enclosing { step situation at_start }
    Order => Order { graph by rank situation condition }
    Stored => Stored { assignment condition }
    Event => Event { event stored }
    Momentary => Momentary { targets condition }
    Dependent => Dependent { owner statement }
    Target => Target { word mask }
    Term => Term { word mask state }
    Edges => Edges { word last rises falls }
    Seen => Seen { word bits }
    NumberRow => NumberRow { initial min max }
    Retained => Retained { slot key }
    Code => Code { start len }
}

/// An index is the literal of what it wraps.
macro_rules! indices {
    ($($name:ident)*) => {$(
        impl Row for $name {
            fn literal(&self) -> TokenStream {
                let index = self.0.literal();
                quote!($name(#index))
            }
        }
    )*};
}

indices! { Armed Bit Course Number Since Stamp }

/// A variant with named fields is the literals of its fields.
macro_rules! variant {
    ($enum:ident::$variant:ident { $($field:ident),* }) => {{
        $(let $field = $field.literal();)*
        quote!($enum::$variant { $($field: #$field),* })
    }};
}

/// An enum without fields is a path.
macro_rules! names {
    ($($name:ident { $($variant:ident)* })*) => {$(
        impl Row for $name {
            fn literal(&self) -> TokenStream {
                match self { $($name::$variant => quote!($name::$variant)),* }
            }
        }
    )*};
}

names! {
    Edge { Rising Falling }
    Evolution { Scan Stable }
    Unit { Milliseconds Seconds }
}

impl Row for u8 {
    fn literal(&self) -> TokenStream {
        let literal = Literal::u8_unsuffixed(*self);
        quote!(#literal)
    }
}

impl Row for u16 {
    fn literal(&self) -> TokenStream {
        let literal = Literal::u16_unsuffixed(*self);
        quote!(#literal)
    }
}

impl Row for u32 {
    fn literal(&self) -> TokenStream {
        let literal = Literal::u32_unsuffixed(*self);
        quote!(#literal)
    }
}

impl Row for i32 {
    fn literal(&self) -> TokenStream {
        let literal = Literal::i32_unsuffixed(*self);
        quote!(#literal)
    }
}

impl Row for bool {
    fn literal(&self) -> TokenStream {
        quote!(#self)
    }
}

impl<T: Row> Row for Option<T> {
    fn literal(&self) -> TokenStream {
        match self {
            Some(value) => {
                let value = value.literal();
                quote!(Some(#value))
            }
            None => quote!(None),
        }
    }
}

impl<T: Row> Row for Vec<T> {
    fn literal(&self) -> TokenStream {
        let rows = self.iter().map(Row::literal);
        quote!(&[#(#rows),*])
    }
}

impl Row for Run {
    fn literal(&self) -> TokenStream {
        if *self == Run::EMPTY {
            return quote!(Run::EMPTY);
        }
        let (start, len) = (self.start.literal(), self.len.literal());
        quote!(Run { start: #start, len: #len })
    }
}

impl Row for Slot {
    fn literal(&self) -> TokenStream {
        match self {
            Slot::Bit(bit) => {
                let bit = bit.literal();
                quote!(Slot::Bit(#bit))
            }
            Slot::Number(number) => {
                let number = number.literal();
                quote!(Slot::Number(#number))
            }
        }
    }
}

impl Row for Condition {
    fn literal(&self) -> TokenStream {
        if *self == Condition::ALWAYS {
            return quote!(Condition::ALWAYS);
        }
        let (terms, rest) = (self.terms.literal(), self.rest.literal());
        quote!(Condition { terms: #terms, rest: #rest })
    }
}

impl Row for Rest {
    fn literal(&self) -> TokenStream {
        let (variant, row) = match self {
            Rest::None => return quote!(Rest::None),
            Rest::Elapsed(row) => (quote!(Elapsed), row.literal()),
            Rest::Running(row) => (quote!(Running), row.literal()),
            Rest::Code(row) => (quote!(Code), row.literal()),
            Rest::Logic(row) => (quote!(Logic), row.literal()),
        };
        quote!(Rest::#variant(#row))
    }
}

impl Row for Crossing {
    fn literal(&self) -> TokenStream {
        match self {
            Crossing::Within {
                actions,
                leaves,
                enters,
            } => variant!(Crossing::Within {
                actions,
                leaves,
                enters
            }),
            Crossing::Across {
                actions,
                entrance,
                exit,
            } => variant!(Crossing::Across {
                actions,
                entrance,
                exit
            }),
        }
    }
}

impl Row for Preset {
    fn literal(&self) -> TokenStream {
        match self {
            Preset::Constant(ms) => {
                let ms = ms.literal();
                quote!(Preset::Constant(#ms))
            }
            Preset::Number(number, unit) => {
                let (number, unit) = (number.literal(), unit.literal());
                quote!(Preset::Number(#number, #unit))
            }
        }
    }
}

impl Row for Forced {
    fn literal(&self) -> TokenStream {
        match self {
            Forced::Set(set) => {
                let set = set.literal();
                quote!(Forced::Set(#set))
            }
            Forced::Current => quote!(Forced::Current),
        }
    }
}

impl Row for Assignment {
    fn literal(&self) -> TokenStream {
        match self {
            Assignment::Bit(bit, value) => {
                let (bit, value) = (bit.literal(), value.literal());
                quote!(Assignment::Bit(#bit, #value))
            }
            Assignment::Number(number, value) => {
                let (number, value) = (number.literal(), value.literal());
                quote!(Assignment::Number(#number, #value))
            }
        }
    }
}

impl Row for Timer {
    fn literal(&self) -> TokenStream {
        match self {
            Timer::Own { since, preset } => variant!(Timer::Own { since, preset }),
            Timer::Any {
                step,
                activated,
                preset,
            } => variant!(Timer::Any {
                step,
                activated,
                preset
            }),
        }
    }
}

impl Row for Watch {
    #[rustfmt::skip]
    fn literal(&self) -> TokenStream {
        match self {
            Watch::Edge { operand, edge, last, result, from_false } =>
                variant!(Watch::Edge { operand, edge, last, result, from_false }),
            Watch::Timer { enable, preset, unit, last, risen, result } =>
                variant!(Watch::Timer { enable, preset, unit, last, risen, result }),
            Watch::OnDelay { enable, delay, last, risen, result } =>
                variant!(Watch::OnDelay { enable, delay, last, risen, result }),
            Watch::OffDelay { on, hold, last, fallen, result } =>
                variant!(Watch::OffDelay { on, hold, last, fallen, result }),
            Watch::Value { condition, gate, result } =>
                variant!(Watch::Value { condition, gate, result }),
        }
    }
}

impl Row for Op {
    fn literal(&self) -> TokenStream {
        match self {
            Op::Constant(value) => {
                let value = value.literal();
                quote!(Op::Constant(#value))
            }
            Op::Bit(bit) => {
                let bit = bit.literal();
                quote!(Op::Bit(#bit))
            }
            Op::Number(number) => {
                let number = number.literal();
                quote!(Op::Number(#number))
            }
            Op::Elapsed(timer) => {
                let timer = timer.literal();
                quote!(Op::Elapsed(#timer))
            }
            Op::AndElapsed(timer) => {
                let timer = timer.literal();
                quote!(Op::AndElapsed(#timer))
            }
            Op::StepTimer {
                step,
                activated,
                unit,
            } => variant!(Op::StepTimer {
                step,
                activated,
                unit
            }),
            Op::Not => quote!(Op::Not),
            Op::And => quote!(Op::And),
            Op::Or => quote!(Op::Or),
            Op::Xor => quote!(Op::Xor),
            Op::Negate => quote!(Op::Negate),
            Op::Add => quote!(Op::Add),
            Op::Subtract => quote!(Op::Subtract),
            Op::Multiply => quote!(Op::Multiply),
            Op::Divide => quote!(Op::Divide),
            Op::Modulo => quote!(Op::Modulo),
            Op::Equal => quote!(Op::Equal),
            Op::NotEqual => quote!(Op::NotEqual),
            Op::Less => quote!(Op::Less),
            Op::LessOrEqual => quote!(Op::LessOrEqual),
            Op::Greater => quote!(Op::Greater),
            Op::GreaterOrEqual => quote!(Op::GreaterOrEqual),
        }
    }
}
